// SPDX-License-Identifier: BSD-3-Clause
/// How far from equilibrium a specimen is.
#pragma once

#include "breccia/views.hpp"

namespace breccia {

/// Mean resultant on a particle over mean contact force: small values say that a run is quasi-static. 0 without
/// contacts. Particles that `held` marks (one entry each, or none) have a resultant by intention and do not count.
inline double unbalanced_force_ratio(Strided<const Vec3> forces, std::span<const PairForce> pairs,
                                     std::span<const std::uint8_t> held = {}) {
  double resultant = 0, contact = 0;
  std::size_t contacts = 0, particles = 0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (!held.empty() && held[k]) continue;
    resultant += forces[k].norm();
    ++particles;
  }
  for (const PairForce& f : pairs) {
    const double size = std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
    contact += size;
    contacts += size > 0;
  }
  return contact > 0 && particles > 0 ? resultant / double(particles) / (contact / double(contacts)) : 0.0;
}

inline double unbalanced_force_ratio(const SimulationView& view, std::span<const std::uint8_t> held = {}) {
  return unbalanced_force_ratio(view.particles.force, view.pairs.force, held);
}

}  // namespace breccia
