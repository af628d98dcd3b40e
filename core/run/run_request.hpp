// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

class RankLink;

/// A run as a user asks for it.
struct RunRequest {
  std::filesystem::path file, output;  ///< the workflow; the folder of the results: empty for the usual one
  std::filesystem::path resume, from;  ///< results to go on with; another run's checkpoint to begin from; may be empty
  std::vector<std::string> overrides;
  std::string variant;
  bool overwrite = false, accept_changed_plugins = false;
  RankLink* link = nullptr;  ///< to the other ranks of the job, which ask for the same; null where there is none
};

}  // namespace breccia
