// SPDX-License-Identifier: BSD-3-Clause
#include "study/jobs.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <thread>

#include "breccia/error.hpp"

namespace breccia {

namespace {

pid_t start(const SweepJob& job) {
  std::error_code failed;
  std::filesystem::create_directories(job.log.parent_path(), failed);
  if (failed) throw UserError("cannot make the folder " + job.log.parent_path().string() + ": " + failed.message());
  std::vector<std::string> texts{"breccia"};
  texts.insert(texts.end(), job.arguments.begin(), job.arguments.end());
  std::vector<char*> arguments;
  arguments.reserve(texts.size() + 1);
  for (std::string& t : texts) arguments.push_back(t.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&files);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t id = 0;
  // The program that is running, even if its file has been replaced meanwhile.
  const int error = posix_spawn(&id, "/proc/self/exe", &files, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw UserError(std::string("cannot start the process of a case: ") + std::strerror(error));
  return id;
}

JobEnd end_of(int status) { return WIFSIGNALED(status) ? JobEnd{0, WTERMSIG(status)} : JobEnd{WEXITSTATUS(status), 0}; }

}  // namespace

void run_jobs(const std::vector<SweepJob>& jobs, int at_once, const std::function<bool()>& cancelled,
              const std::function<void(std::size_t, const JobEnd&)>& ended) {
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  bool asked = false;
  while (next < jobs.size() || !running.empty()) {
    if (!asked && cancelled()) {
      asked = true;
      next = jobs.size();
      for (const auto& [id, job] : running) kill(id, SIGINT);
      continue;
    }
    while (next < jobs.size() && running.size() < std::size_t(at_once)) {
      const pid_t id = start(jobs[next]);
      running[id] = next++;
    }
    for (auto it = running.begin(); it != running.end();) {
      int status = 0;
      if (waitpid(it->first, &status, WNOHANG) != it->first) {
        ++it;
        continue;
      }
      const std::size_t job = it->second;
      it = running.erase(it);
      ended(job, end_of(status));
    }
    if (!running.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void end_with(int parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) std::raise(SIGTERM);  // it went before that was set
}

}  // namespace breccia
