// SPDX-License-Identifier: BSD-3-Clause
#include "movie.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include "breccia/atomic_file.hpp"
#include "breccia/error.hpp"
#include "style.hpp"

extern char** environ;

namespace breccia::pictures {
namespace fs = std::filesystem;
namespace {

std::string found_program() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = (folder.empty() ? "." : folder) + "/ffmpeg";
    if (access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file)) return file;
  }
  throw Unavailable("there is no program ffmpeg on this machine (Debian: package ffmpeg)");
}

/// A reader that has ended must not end the writer: without the signal, writing fails with EPIPE.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t waiting;
    sigpending(&waiting);
    was_waiting_ = sigismember(&waiting, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec now{0, 0};
    if (!was_waiting_)
      while (sigtimedwait(&pipe_, nullptr, &now) < 0 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_waiting_ = false;
};

std::vector<std::string> arguments(MovieFormat format, const Image& first, double rate, const fs::path& to) {
  std::vector<std::string> a = {"ffmpeg",
                                "-nostdin",
                                "-loglevel",
                                "error",
                                "-y",
                                "-f",
                                "rawvideo",
                                "-pix_fmt",
                                "rgb24",
                                "-s",
                                std::to_string(first.width) + "x" + std::to_string(first.height),
                                "-framerate",
                                significant(rate, 6),
                                "-i",
                                "pipe:0"};
  const auto add = [&](std::initializer_list<const char*> more) { a.insert(a.end(), more.begin(), more.end()); };
  // Players want an even number of rows and columns, and colours at half their number.
  const char* even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
  switch (format) {
    case MovieFormat::mp4:
      add({"-vf", even, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", "-f",
           "mp4"});
      break;
    case MovieFormat::webm:
      add({"-vf", even, "-c:v", "libvpx-vp9", "-pix_fmt", "yuv420p", "-crf", "24", "-b:v", "0", "-row-mt", "1",
           "-deadline", "good", "-cpu-used", "4", "-f", "webm"});
      break;
    case MovieFormat::gif:
      add({"-filter_complex", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=none", "-f",
           "gif"});
      break;
  }
  a.push_back("file:" + to.string());
  return a;
}

}  // namespace

std::string ending_of(MovieFormat format) {
  return format == MovieFormat::mp4 ? "mp4" : format == MovieFormat::webm ? "webm" : "gif";
}

Movie::Movie(const fs::path& file, MovieFormat format, double frames_per_second)
    : file_(file),
      partial_(file.string() + ".partial"),
      log_(file.string() + ".log.partial"),
      format_(format),
      rate_(frames_per_second),
      program_(found_program()) {}

Movie::~Movie() {
  if (pipe_ >= 0) close(pipe_);
  if (process_ > 0) {  // something else went wrong: what it was writing is not wanted
    kill(process_, SIGTERM);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  std::error_code ignored;
  fs::remove(partial_, ignored);
  fs::remove(log_, ignored);
}

void Movie::start(const Image& first) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Unavailable("ffmpeg cannot be started");
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[0], 0);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, 2, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigmask(&how, &none);
  posix_spawnattr_setsigdefault(&how, &usual);
  // A process group of its own: Ctrl-C is for Breccia, which ends ffmpeg in order.
  posix_spawnattr_setpgroup(&how, 0);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> words = arguments(format_, first, rate_, partial_);
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  pid_t process = 0;
  const int error = posix_spawn(&process, program_.c_str(), &files, &how, argv.data(), environ);
  posix_spawnattr_destroy(&how);
  posix_spawn_file_actions_destroy(&files);
  close(ends[0]);
  pipe_ = ends[1];
  if (error != 0) throw Unavailable("ffmpeg cannot be started");
  process_ = process;
}

void Movie::add(const Image& frame) {
  if (process_ == 0) start(frame);
  const NoPipeSignal quiet;
  for (std::size_t done = 0; done < frame.rgb.size();) {
    const ssize_t n = write(pipe_, frame.rgb.data() + done, frame.rgb.size() - done);
    if (n > 0) done += std::size_t(n);
    else if (errno != EINTR) fail();
  }
}

void Movie::fail() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
  if (process_ > 0)
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  std::ifstream in(log_);
  std::string line;
  std::getline(in, line);
  throw UserError("ffmpeg could not make it" + (line.empty() ? "" : ": " + line));
}

void Movie::finish() {
  if (process_ == 0) throw UserError("there are no frames");
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = 0;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
  std::error_code error;
  fs::rename(partial_, file_, error);
  if (error) throw CannotWrite(file_, error.value());
}

}  // namespace breccia::pictures
