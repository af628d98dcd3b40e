// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// A study, or one of its cases, as a user asks for it.
struct StudyRequest {
  std::filesystem::path study, output;  ///< output empty: the usual folder
  int jobs = 0, threads = 1;            ///< jobs 0: as many as keep all cores busy
  bool collect = false;                 ///< runs none: gathers what has finished
  bool overwrite = false;
  std::string one;     ///< number or folder of the case to run; empty: all
  std::string expect;  ///< hash of the inputs that this case is to have; empty: any
  int parent = 0;      ///< the process that started this one; 0: the user
};

}  // namespace breccia
