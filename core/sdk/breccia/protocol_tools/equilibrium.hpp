// SPDX-License-Identifier: BSD-3-Clause
/// How far from equilibrium a specimen is.
#pragma once

#include "breccia/views.hpp"

namespace breccia {

/// Mean resultant on a particle over mean contact force: small values say that a run is quasi-static. 0 without contacts.
inline double unbalanced_force_ratio(const SimulationView& view) {
  double resultant = 0, contact = 0;
  std::size_t contacts = 0;
  for (const Vec3& f : view.particles.force) resultant += f.norm();
  for (const PairForce& f : view.pairs.force) {
    const double size = std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
    contact += size;
    contacts += size > 0;
  }
  return contact > 0 ? resultant / double(view.particles.size()) / (contact / double(contacts)) : 0.0;
}

}  // namespace breccia
