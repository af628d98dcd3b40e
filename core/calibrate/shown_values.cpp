// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/shown_values.hpp"

#include <cmath>

#include "config/units.hpp"

namespace breccia {

namespace {

Quantity quantity_of(const CalibrationTrials& trials, std::size_t k, const std::string& text) {
  const std::string& unit = trials.parameter_units()[k];
  return read_quantity(text, unit.empty() ? "1" : unit);
}

}  // namespace

double si_value(const CalibrationTrials& trials, std::size_t k, const std::string& text) {
  return quantity_of(trials, k, text).si;
}

ChosenUnit chosen_unit(const CalibrationTrials& trials, std::size_t k) {
  const Quantity q = quantity_of(trials, k, trials.calibration().parameters[k].scale.text(1));
  if (q.offset != 0) return {};  // nothing is in proportion to degrees Celsius
  return {q.unit, q.factor};
}

ChosenUnit chosen_unit(const TargetMeasure& m) { return {m.written, m.factor}; }

std::string shown(const CalibrationTrials& trials, std::size_t k, const std::string& text, int digits) {
  const double largest = si_value(trials, k, trials.calibration().parameters[k].scale.text(1));
  return shown_quantity(si_value(trials, k, text), trials.parameter_units()[k], chosen_unit(trials, k), largest, digits)
      .text(" ");
}

std::string shown(const TargetMeasure& m, double si, int digits) {
  if (!std::isfinite(si)) return "not measured";
  return shown_quantity(si, m.unit, chosen_unit(m), m.value, digits).text(" ");
}

}  // namespace breccia
