// SPDX-License-Identifier: BSD-3-Clause
/// Strength of finished runs in principal stresses, and the Mohr-Coulomb line through several of them.
/// Source: Jaeger, Cook, Zimmerman (2007), Fundamentals of Rock Mechanics, sections 4.5 and 6.5 and 10.7 (Brazilian
/// test).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "breccia/schema.hpp"

namespace breccia {

/// At failure, compression positive [Pa].
struct PrincipalStresses {
  double sigma_3, sigma_1;
};

/// From a summary: of a test between platens the stresses at the peak of the deviator; of direct tension -T and 0; of a
/// Brazilian test those in the middle of the elastic disc, -T and 3 T. None when the run is none of these, or is loaded
/// in a rigid cell, where nothing fails.
inline std::optional<PrincipalStresses> strength_of(const Json& summary) {
  const auto number = [](const Json& object, const char* key) -> std::optional<double> {
    const auto it = object.find(key);
    return it != object.end() && it->is_number() ? std::optional(it->get<double>()) : std::nullopt;
  };
  if (!summary.is_object()) return {};
  if (const auto tensile = number(summary, "brazilian_tensile_strength_Pa"))
    return PrincipalStresses{-*tensile, 3 * *tensile};
  for (const Json& section : summary) {
    if (!section.is_object() || section.contains("cell_pressure_at_end_Pa")) continue;
    if (const auto tension = number(section, "peak_tension_Pa"); tension && *tension > 0)
      return PrincipalStresses{-*tension, 0};
    const auto whole = number(section, "peak_platen_stress_Pa"),
               deviator = number(section, "peak_deviatoric_platen_stress_Pa");
    if (whole && deviator && *deviator > 0) return PrincipalStresses{*whole - *deviator, *whole};
  }
  return {};
}

/// sigma_1 = uniaxial_strength + slope sigma_3; tau = cohesion + sigma tan(friction_angle).
struct MohrCoulomb {
  double uniaxial_strength;                                                       ///< of the line, not of a test [Pa]
  double slope;                                                                   ///< (1 + sin phi)/(1 - sin phi)
  double cohesion() const { return 0.5 * uniaxial_strength / std::sqrt(slope); }  // [Pa]
  double friction_angle() const { return std::asin((slope - 1) / (slope + 1)); }  // [rad]
};

/// Least squares over the tests whose minor stress is not tensile. None when they all have the same, or without a
/// positive slope.
inline std::optional<MohrCoulomb> mohr_coulomb(const std::vector<PrincipalStresses>& tests) {
  double n = 0, x = 0, y = 0, largest = 0;
  for (const PrincipalStresses& t : tests) {
    if (t.sigma_3 < 0) continue;
    ++n;
    x += t.sigma_3;
    y += t.sigma_1;
    largest = std::max(largest, t.sigma_1);
  }
  if (n < 2) return {};
  x /= n;
  y /= n;
  double xx = 0, xy = 0;
  for (const PrincipalStresses& t : tests) {
    if (t.sigma_3 < 0) continue;
    xx += (t.sigma_3 - x) * (t.sigma_3 - x);
    xy += (t.sigma_3 - x) * (t.sigma_1 - y);
  }
  if (!(xx > 1e-6 * largest * largest) || !(xy > 0)) return {};
  return MohrCoulomb{y - xy / xx * x, xy / xx};
}

}  // namespace breccia
