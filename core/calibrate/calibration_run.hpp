// SPDX-License-Identifier: BSD-3-Clause
/// A calibration, run: its points one batch after the other, each run in a folder of its own.
#pragma once

#include "calibrate/calibration_request.hpp"
#include "calibrate/course.hpp"
#include "study/run_in_folder.hpp"

namespace breccia {

/// The folder of the whole calibration.
std::filesystem::path calibration_folder(const CalibrationRequest& request, const CalibrationTrials& trials);

/// Goes the course as far as results are there, runs what is missing, and writes what came out.
StudyEnd run_calibration(const CalibrationRequest& request, const CalibrationTrials& trials, Host& host);

/// The runs that are known so far (CSV), in the order of their numbers; those of the next batch are not finished.
std::string runs_so_far(const CalibrationRequest& request, const CalibrationTrials& trials, Host& host);

/// One run by itself: `request.trial`, or that of the number `request.one`.
StudyEnd run_trial(const CalibrationRequest& request, const CalibrationTrials& trials, Terminal& terminal);

}  // namespace breccia
