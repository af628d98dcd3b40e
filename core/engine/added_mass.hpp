// SPDX-License-Identifier: BSD-3-Clause
/// Selective mass scaling: more mass for the few particles that ask for the shortest time step.
#pragma once

#include <span>
#include <vector>

#include "breccia/strided.hpp"

namespace breccia {

struct AddedMass {
  double share = 0;           ///< of the total mass
  std::size_t particles = 0;  ///< that got some
  double largest_factor = 1;  ///< on the mass of one
  double step = 0;            ///< the time step that all particles allow by themselves then [s]
};

/// Factors on the masses (and inertias) that raise the time step of each particle by itself, `steps` [s], to a common
/// one, as long as `share` of the total mass allows. A particle's step grows as the root of its mass, a dashpot's
/// constant with the root of the mass being counted in.
AddedMass add_mass(Strided<const double> mass, std::span<const double> steps, double share,
                   std::vector<double>& factors);

}  // namespace breccia
