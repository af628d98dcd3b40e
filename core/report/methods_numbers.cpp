// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "report/methods.hpp"
#include "report/quantity.hpp"

namespace breccia::report {
namespace {

/// The row of the largest size; NaN counts for nothing.
std::size_t row_of_largest(const std::vector<double>& values) {
  std::size_t best = 0;
  double largest = -1;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::abs(values[k]) > largest) {
      largest = std::abs(values[k]);
      best = k;
    }
  return best;
}

}  // namespace

std::optional<StrainRate> strain_rate(const RunFiles& run) {
  const Curve* strain = role::find(run.curves, {role::machine_strain, role::diametral_strain, role::strain});
  const Curve* load = role::find(run.curves, {role::machine_stress, role::load, role::splitting_stress, role::stress});
  const Curve* time = run.curve("time");
  if (!strain || !load || !time || time->values.empty()) return {};
  const std::size_t peak = row_of_largest(load->values);
  const double span = time->values[peak] - time->values[0];
  const double rate = std::abs(strain->values[peak] - strain->values[0]) / span;
  if (!(span > 0) || !std::isfinite(rate)) return {};
  return StrainRate{strain->name, rate};
}

double inertial_number(const RunFiles& run, double rate) {
  const double pressure = run.number("stress.largest_mean_stress_Pa"),
               density = number_of(run.given("material.density")), radius = run.number("packing.radius_mean.got");
  if (!(pressure > 0)) return std::numeric_limits<double>::quiet_NaN();
  return rate * 2 * radius * std::sqrt(density / pressure);
}

}  // namespace breccia::report
