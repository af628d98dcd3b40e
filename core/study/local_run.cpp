// SPDX-License-Identifier: BSD-3-Clause
#include "study/local_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <thread>

#include "study/case_folder.hpp"
#include "study/jobs.hpp"
#include "study/study_results.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

/// What became of a case whose process has ended; of one that could not say so itself, in its folder and in `crashes`.
CaseRecord record_of(const LocalCase& c, const fs::path& log, const JobEnd& end,
                     std::map<std::string, std::string>& crashes, Host& host) {
  CaseRecord now = read_case(c.folder, c.hash, host);
  if (now.state == CaseState::finished || now.state == CaseState::failed || host.cancelled()) return now;
  const std::string said = last_line(log);
  const std::string how =
      end.signal ? fmt::format("the process was ended by signal {} ({})", end.signal, strsignal(end.signal))
                 : fmt::format("the process ended with code {}", end.code);
  now = {CaseState::failed,
         end.signal || said.empty() ? how + (said.empty() ? "" : "; its last words: " + said) : said};
  crashes[c.name] = now.error;
  try {
    record_crash(c.folder, c.hash, now.error, host);
  } catch (const UserError& e) { host.warn(e.what()); }
  return now;
}

}  // namespace

int jobs_at_once(int asked, int threads) {
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  return asked > 0 ? asked : std::max(1, cores / threads);
}

std::map<std::string, std::string> run_locally(const std::vector<LocalCase>& cases, const fs::path& logs, int at_once,
                                               Host& host) {
  std::map<std::string, std::string> crashes;
  std::vector<SweepJob> jobs;
  for (const LocalCase& c : cases) jobs.push_back({c.arguments, logs / (c.name + ".log")});
  std::size_t done = 0;
  run_jobs(
      jobs, at_once, [&] { return host.cancelled(); },
      [&](std::size_t k, const JobEnd& end) {
        const CaseRecord now = record_of(cases[k], jobs[k].log, end, crashes, host);
        std::error_code ignored;
        if (now.state == CaseState::finished) fs::remove(jobs[k].log, ignored);  // run.log has the same
        const std::string state = now.state == CaseState::failed
                                      ? "failed: " + now.error.substr(0, now.error.find('\n'))
                                      : state_text(now.state);
        host.info(fmt::format("[{}/{}] {}: {}", ++done, cases.size(), cases[k].name, state));
      });
  return crashes;
}

}  // namespace breccia
