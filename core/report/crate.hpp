// SPDX-License-Identifier: BSD-3-Clause
/// RO-Crate 1.1 metadata (https://w3id.org/ro/crate/1.1) of a folder of results: what a repository or another program
/// reads off it.
#pragma once

#include "report/report_pages.hpp"

namespace breccia::report {

struct CrateContent {
  std::string name, description;
  std::filesystem::path folder;
  std::vector<std::string> files;                         ///< relative to it
  std::vector<std::string> folders;                       ///< of cases, relative to it
  const RunFiles* run = nullptr;                          ///< that made the files; of a study an example of its cases
  std::string part = "Results of one case of the study";  ///< what each of `folders` holds
};

Json crate_metadata(const CrateContent& content, const ReportFacts& facts);

constexpr const char* crate_file = "ro-crate-metadata.json";

}  // namespace breccia::report
