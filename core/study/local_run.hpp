// SPDX-License-Identifier: BSD-3-Clause
/// Cases on this machine, each by a process of this program.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "breccia/services.hpp"

namespace breccia {

struct LocalCase {
  std::string name;                    ///< as messages tell of it; also of its log
  std::filesystem::path folder;        ///< of its results
  std::string hash;                    ///< of its inputs
  std::vector<std::string> arguments;  ///< of the process that runs it
};

/// Runs them in their order, `at_once` at a time; tells of each as it ends. `logs`: for the standard streams of the
/// processes. Returns, by name, why a case failed that could not say so itself. Once the host is cancelled, those that
/// run are stopped and no other begins.
std::map<std::string, std::string> run_locally(const std::vector<LocalCase>& cases, const std::filesystem::path& logs,
                                               int at_once, Host& host);

/// `asked` for, or as many as keep all cores busy with that many threads each.
int jobs_at_once(int asked, int threads);

}  // namespace breccia
