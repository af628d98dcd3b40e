// SPDX-License-Identifier: BSD-3-Clause
/// The files that a calibration leaves.
#pragma once

#include "calibrate/evidence.hpp"
#include "calibrate/outcome.hpp"

namespace breccia {

/// Those that are always written.
std::vector<std::string> calibration_file_names();

/// "start", "scaled", ...: why a point was run.
std::string why_text(CoursePoint::Why why);

/// One row per run that is known, in their order.
std::string runs_csv(const CalibrationTrials& trials, const Course& course, const std::vector<TrialRecord>& records);

/// calibration.json, runs.csv, points.csv, report.md, best/<workflow>.yaml, the charts and, of contradicting targets,
/// pareto.csv. `whole`: the course has come to its end. `shown`: where the folder will be. The files.
std::vector<std::filesystem::path> write_calibration(const CalibrationTrials& trials, Course& course,
                                                     const std::vector<TrialRecord>& records,
                                                     const CalibrationOutcome& outcome, bool whole,
                                                     const std::filesystem::path& folder,
                                                     const std::filesystem::path& shown, Host& host);

/// report.md, with the charts that there are.
std::string calibration_report(const CalibrationTrials& trials, const Course& course, const CalibrationOutcome& outcome,
                               bool whole, const std::vector<std::filesystem::path>& charts);

/// Draws what there is to see; what cannot be drawn is a warning.
std::vector<std::filesystem::path> draw_calibration(const CalibrationTrials& trials, Course& course,
                                                    const CalibrationOutcome& outcome,
                                                    const std::filesystem::path& folder, Host& host);

}  // namespace breccia
