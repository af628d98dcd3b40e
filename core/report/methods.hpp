// SPDX-License-Identifier: BSD-3-Clause
/// The paragraph that the methods section of a paper can take.
#pragma once

#include "plugin/registry.hpp"
#include "report/calibration_files.hpp"
#include "report/study_files.hpp"

namespace breccia::report {

/// Paragraphs of plain text. Every number is one of the run's files, or follows from some of them as the text says;
/// what the files do not tell is not told.
std::vector<std::string> methods_text(const RunFiles& run);
/// Of a study: what was varied, what the specimens came to, and one case of each workflow for all else.
std::vector<std::string> methods_text(const StudyFiles& study);
/// Of a calibration: what was sought and found, and one run of each workflow for all else.
std::vector<std::string> methods_text(const CalibrationFiles& calibration);

std::string methods_html(const std::vector<std::string>& paragraphs);
/// With the sources of the models below.
std::string methods_markdown(const std::string& title, const std::vector<std::string>& paragraphs,
                             const std::vector<std::pair<std::string, std::string>>& sources);

/// How fast the specimen was strained, from the curves; nothing without them.
struct StrainRate {
  std::string curve;  ///< "platen_strain"
  double rate = 0;    ///< [1/s], mean from the beginning of loading to the largest load, without sign
};
std::optional<StrainRate> strain_rate(const RunFiles& run);

/// Inertial number I = rate d sqrt(rho / p), with the mean diameter d, the density rho of the particles, and the
/// largest mean stress p; NaN when one of them is not in the files. (da Cruz et al. 2005, Phys. Rev. E 72, 021309.)
double inertial_number(const RunFiles& run, double rate);

}  // namespace breccia::report
