// SPDX-License-Identifier: BSD-3-Clause
/// `breccia report`: one file that tells of a run or a study and needs nothing else, a paragraph for a paper, and
/// metadata for repositories.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/services.hpp"
#include "plugin/registry.hpp"

namespace breccia::report {

struct ReportRequest {
  std::filesystem::path folder;          ///< of a run or a study
  std::filesystem::path output;          ///< the page; empty: report.html in that folder
  bool overwrite = false;                ///< an earlier report may be replaced
  std::vector<std::string> authors;      ///< of the results
  std::string licence;                   ///< of the results: an SPDX name, an address, or words
  std::optional<PluginChoice> renderer;  ///< draws charts that the results do not have
};

/// The files that were made: the page; beside it the paragraph; with the results the metadata. UserError, with nothing
/// changed, when the folder is not that of a run or a study, or when a file is there and may not be replaced.
std::vector<std::filesystem::path> write_report(const ReportRequest& request, const Registry& registry, Host& host);

}  // namespace breccia::report
