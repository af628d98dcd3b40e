// SPDX-License-Identifier: BSD-3-Clause
/// Stiffness of a contact from a modulus: that of a bar between the centres, as broad as the smaller particle.
/// Source: the effective modulus of the linear contact model of Itasca's PFC (method `deformability` of its manual).
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia {

/// k = E A/(r_i + r_j), A = pi r_min^2, of discs 2 r_min t.
struct EffectiveModulus {
  double section = 0;   ///< E A/r_min^2 of spheres [Pa]
  double breadth = 0;   ///< E A/r_min of discs [N/m]
  double constant = 0;  ///< or k itself, the same for all contacts [N/m]

  EffectiveModulus(std::optional<double> modulus, std::optional<double> stiffness, const Assembly& a) {
    const bool discs = a.dimension == 2;
    if (modulus) (discs ? breadth : section) = *modulus * (discs ? 2 * a.thickness : std::numbers::pi);
    if (stiffness) constant = *stiffness;
  }
  BRECCIA_KERNEL double operator()(const Contact& c) const {
    const double least = c.radius_i < c.radius_j ? c.radius_i : c.radius_j;
    return constant + (section * least + breadth) * least / c.touching();
  }
};

}  // namespace breccia
