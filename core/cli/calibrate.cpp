// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "calibrate/calibration_run.hpp"
#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "study/jobs.hpp"

namespace breccia::cli {
namespace {

int code_of(StudyEnd end) { return end == StudyEnd::finished ? ok : end == StudyEnd::stopped ? interrupted : failure; }

}  // namespace

int calibrate(const CalibrateArguments& a) {
  if (a.parent > 0) end_with(a.parent);
  const CalibrationTrials trials(a.file);
  if (a.one > 0 || !a.trial.empty()) {
    Console console(a.threads);
    return code_of(run_trial(a, trials, console));
  }
  Console console(1);
  if (a.cases) {
    fmt::print("{}", runs_so_far(a, trials, console));
    return ok;
  }
  for (const std::string& doubt : trials.warnings()) console.warn(doubt);
  return code_of(run_calibration(a, trials, console));
}

}  // namespace breccia::cli
