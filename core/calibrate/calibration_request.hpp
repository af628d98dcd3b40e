// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// A calibration, or one of its runs, as a user asks for it.
struct CalibrationRequest {
  std::filesystem::path file, output;  ///< output empty: the usual folder
  int jobs = 0, threads = 1;           ///< jobs 0: as the file says, or as many as keep all cores busy
  bool collect = false;                ///< runs none: tells of what has finished
  bool retry_failed = false;
  std::size_t one = 0;  ///< number of the run to be made, from 1; 0: all
  std::string trial;    ///< the same for a process of ours: what it is, as JSON
  std::string expect;   ///< hash of the inputs that it is to have
  int parent = 0;       ///< the process that started this one; 0: the user
};

}  // namespace breccia
