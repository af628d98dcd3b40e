// SPDX-License-Identifier: BSD-3-Clause
/// What the folders of the runs tell.
#pragma once

#include "calibrate/course.hpp"
#include "study/case_folder.hpp"

namespace breccia {

/// A run of a point as it stands.
struct TrialRecord {
  Trial trial;
  CaseState state = CaseState::absent;
  std::string folder, hash;  ///< below `cases`; empty when the run is not in order
  TrialResult result;        ///< of one that has finished or failed
  bool is_open() const { return state != CaseState::finished && state != CaseState::failed; }
};

class Evidence {
 public:
  /// `results`: the folder of the calibration.
  Evidence(const CalibrationTrials& trials, std::filesystem::path results)
      : trials_(trials), results_(std::move(results)) {}
  /// Reads it. A run that the workflow refuses has failed. UserError when a summary does not have what a target asks
  /// for, or has it in another unit.
  TrialRecord look(const Trial& t, Host& host) const;
  std::filesystem::path folder(const TrialRecord& r) const { return results_ / "cases" / r.folder; }

 private:
  std::vector<double> values_in(const Json& summary, std::size_t workflow) const;
  const CalibrationTrials& trials_;
  std::filesystem::path results_;
};

}  // namespace breccia
