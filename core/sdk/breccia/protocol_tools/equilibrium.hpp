// SPDX-License-Identifier: BSD-3-Clause
/// How far from equilibrium a specimen is.
#pragma once

#include "breccia/block_sum.hpp"

namespace breccia {

/// Mean resultant on a particle over mean contact force: small values say that a run is quasi-static. 0 without
/// contacts. Particles that `held` marks (one entry each, or none) have a resultant by intention and do not count. Of a
/// specimen in parts that of the whole.
inline double unbalanced_force_ratio(const SimulationView& view, std::span<const std::uint8_t> held = {}) {
  BlockSum<double> resultant(view), contact(view);
  ExactSumOf<std::size_t> particles, contacts;
  std::size_t free = 0, touching = 0;
  for (const std::size_t k : view.own_particles()) {
    if (!held.empty() && held[k]) continue;
    resultant.add(k, view.particles.force[k].norm());
    ++free;
  }
  for (const std::size_t k : view.own_pairs()) {
    const PairForce& f = view.pairs.force[k];
    const double size = std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
    contact.add(view.pairs.i[k], size);
    touching += size > 0;
  }
  particles.add(free);
  contacts.add(touching);
  const auto [force, of_contacts, n, m] = view.sum(resultant.exact(), contact.exact(), particles, contacts);
  return of_contacts > 0 && n > 0 ? force / double(n) / (of_contacts / double(m)) : 0.0;
}

}  // namespace breccia
