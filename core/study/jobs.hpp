// SPDX-License-Identifier: BSD-3-Clause
/// Processes of this program, several at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace breccia {

struct SweepJob {
  std::vector<std::string> arguments;  ///< without the program's name
  std::filesystem::path log;           ///< of both its streams; its folder is made
};

struct JobEnd {
  int code = 0;
  int signal = 0;  ///< that ended it; 0: none did
};

/// Runs the jobs in their order, at most `at_once` at a time, and tells of each as it ends. Once `cancelled`, those
/// that run are asked to stop (SIGINT, once) and waited for, and no other begins. They are process groups of their own:
/// Ctrl-C on the terminal reaches only this program.
void run_jobs(const std::vector<SweepJob>& jobs, int at_once, const std::function<bool()>& cancelled,
              const std::function<void(std::size_t job, const JobEnd& end)>& ended);

/// For a job: ends itself (SIGTERM) when the process of that id, which must have started it, is gone.
void end_with(int parent);

}  // namespace breccia
