// SPDX-License-Identifier: BSD-3-Clause
/// The pages of a report.
#pragma once

#include "report/calibration_files.hpp"
#include "report/figures.hpp"
#include "report/run_files.hpp"
#include "report/study_files.hpp"

namespace breccia::report {

/// What the results themselves do not say.
struct ReportFacts {
  std::vector<std::string> authors;
  std::string licence;  ///< of the results: an SPDX name or an address; empty when none was given
  std::string date;     ///< of the report, "2026-11-29"
};

/// `methods`: markup.
std::string run_page(const RunFiles& run, const std::vector<Figure>& figures, const std::string& methods,
                     const Registry& registry, const ReportFacts& facts);
std::string study_page(const StudyFiles& study, const std::vector<Figure>& figures, const std::string& methods,
                       const Registry& registry, const ReportFacts& facts);
std::string calibration_page(const CalibrationFiles& calibration, const std::vector<Figure>& figures,
                             const std::string& methods, const Registry& registry, const ReportFacts& facts);

std::string heading(std::string_view kind, std::string_view title, const std::vector<std::string>& authors,
                    const std::string& about);
std::string footer(const ReportFacts& facts);

}  // namespace breccia::report
