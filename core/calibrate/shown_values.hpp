// SPDX-License-Identifier: BSD-3-Clause
/// Values of parameters and targets as the terminal and reports tell them: in the unit in which the file has them.
#pragma once

#include "calibrate/trials.hpp"
#include "results/shown_quantity.hpp"

namespace breccia {

/// Value of a parameter in SI.
double si_value(const CalibrationTrials& trials, std::size_t parameter, const std::string& text);

/// The unit of its range, and of a target; nameless for pure numbers.
ChosenUnit chosen_unit(const CalibrationTrials& trials, std::size_t parameter);
ChosenUnit chosen_unit(const TargetMeasure& m);

/// "1.13 GPa": a value of a parameter, to that many digits.
std::string shown(const CalibrationTrials& trials, std::size_t parameter, const std::string& text, int digits = 4);
/// The same of a target; "not measured".
std::string shown(const TargetMeasure& m, double si, int digits = 4);

constexpr int digits_of_errors = 2;     ///< of deviations
constexpr int digits_of_intervals = 3;  ///< of their ends
constexpr int digits_of_ranges = 6;     ///< as a user gave them

}  // namespace breccia
