// SPDX-License-Identifier: BSD-3-Clause
/// Stiffness of a contact from a modulus: that of a bar between the centres, as broad as the smaller particle, or of
/// the two grains one behind the other, each a bar as broad as it is. Sources: the effective modulus of the linear
/// contact model of Itasca's PFC (method `deformability` of its manual); Potyondy, Cundall (2004), Int. J. Rock Mech.
/// Min. Sci. 41, 1329-1364 (k_n of a grain; recalled).
#pragma once

#include <numbers>

#include "breccia/contact_law.hpp"

namespace breccia {

enum class ModulusOf { contact, grains };

/// Of the contact k = E A/(r_i + r_j), A = pi r_min^2, of discs 2 r_min t. Of the grains 1/k = 1/k_i + 1/k_j with k_i =
/// 4 E r_i, of discs 2 E t: k = 4 E r_i r_j/(r_i + r_j), of discs E t.
struct EffectiveModulus {
  double section = 0;   ///< E A/r_min^2 of spheres [Pa]
  double breadth = 0;   ///< E A/r_min of discs [N/m]
  double product = 0;   ///< k (r_i + r_j)/(r_i r_j) of spheres as grains [Pa]
  double constant = 0;  ///< or k itself, the same for all contacts [N/m]

  EffectiveModulus(std::optional<double> modulus, std::optional<double> stiffness, const Assembly& a,
                   ModulusOf of = ModulusOf::contact) {
    const bool discs = a.dimension == 2, grains = of == ModulusOf::grains;
    if (modulus && grains) (discs ? constant : product) = *modulus * (discs ? a.thickness : 4);
    if (modulus && !grains) (discs ? breadth : section) = *modulus * (discs ? 2 * a.thickness : std::numbers::pi);
    if (stiffness) constant = *stiffness;
  }
  BRECCIA_KERNEL double operator()(const Contact& c) const {
    const double least = c.radius_i < c.radius_j ? c.radius_i : c.radius_j;
    return constant + ((section * least + breadth) * least + product * c.radius_i * c.radius_j) / c.touching();
  }
};

}  // namespace breccia
