// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "calibrate/calibration.hpp"
#include "config/number.hpp"

namespace breccia {

double ParameterScale::number(double share) const {
  return log ? from * std::pow(to / from, share) : from + share * (to - from);
}

std::string ParameterScale::text(double share) const {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", number(std::clamp(share, 0.0, 1.0)));
  const auto rounded = to_double(*scan_decimal(buffer));
  // An end of the range may have more digits than that.
  return format_number(std::clamp(rounded.value_or(from), from, to)) + unit;
}

double ParameterScale::share(const std::string& text) const {
  const auto number = scan_decimal(text);
  BRECCIA_ASSERT(number);
  const double value = to_double(*number).value_or(from);
  const double share = log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
  return std::clamp(share, 0.0, 1.0);
}

double TargetMeasure::of(double si) const {
  if (!log) return si;
  return si > 0 ? std::log(si) : NAN;
}

double TargetMeasure::back(double on_scale) const { return log ? std::exp(on_scale) : on_scale; }

double TargetMeasure::scatter_on_scale() const { return log ? scatter / value : scatter; }

}  // namespace breccia
