// SPDX-License-Identifier: BSD-3-Clause
/// What a calibration has found, and what is to be said of it.
#pragma once

#include "calibrate/course.hpp"

namespace breccia {

struct ParameterOutcome {
  std::string best, low, high;  ///< as a user would write them; the ends of the interval: 5 % and 95 %
  double share = 0, low_share = 0, high_share = 1;  ///< of the range
  std::vector<SearchSensitivity> of_target;         ///< empty without a model
};

struct TargetOutcome {
  double predicted = NAN, error = NAN;  ///< by the model: value (SI), relative or absolute deviation on the scale
  double measured = NAN;                ///< mean of the check (SI)
  double scatter = NAN;                 ///< from one packing to another: SI
  std::size_t packings = 0;             ///< of the check that gave a value
  double residual = NAN;                ///< (measured - wanted) in units of the experiment's scatter
  double of_packings = NAN;             ///< the same in units of the scatter of packings
  double reach = NAN;  ///< least distance that the model promises anywhere in the range, in units of the scatter
};

/// One point of the front between targets that contradict each other.
struct ParetoPoint {
  TrialPoint values;
  std::vector<double> predicted, distance;  ///< per target: SI, in units of the experiment's scatter
};

struct CalibrationOutcome {
  bool has_best = false, has_model = false;
  TrialPoint best;
  std::vector<ParameterOutcome> parameters;
  std::vector<TargetOutcome> targets;
  std::vector<ParetoPoint> front;     ///< only where targets contradict each other
  std::vector<std::string> warnings;  ///< in plain sentences
  std::size_t runs = 0, failed = 0, points = 0;
  std::size_t out_of_time = 0;  ///< of those that failed
};

/// Of a course that has come to its end, or as far as it has come.
CalibrationOutcome outcome_of(const CalibrationTrials& trials, Course& course, Host& host);

/// Distance from the wanted value, in units of the experiment's scatter.
double residual_of(const TargetMeasure& m, double on_scale);

}  // namespace breccia
