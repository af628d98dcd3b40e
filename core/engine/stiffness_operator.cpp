// SPDX-License-Identifier: BSD-3-Clause
#include "engine/stiffness_operator.hpp"

#include <algorithm>

namespace breccia {

StiffnessOperator::StiffnessOperator(State& s, const Interactions& law, const Incidence& in, double reach, int threads,
                                     RankLink* link)
    : held_(s.particles.held) {
  const Particles& p = s.particles;
  const std::size_t n = p.size(), pairs = s.pairs.size();
  inverse_mass_.resize(n);
  inverse_inertia_.resize(n);
  std::vector<ContactStiffness> stiffness(pairs);
  std::vector<std::uint8_t> counts(pairs);
  std::vector<double*> columns;
  const PairBatch all = whole_batch(s, columns);
  bool damped = false, moments = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : damped, moments)
  for (std::size_t chunk = 0; chunk < (pairs + PairBatch::chunk - 1) / PairBatch::chunk; ++chunk) {
    PairBatch mine = all;
    mine.begin = chunk * PairBatch::chunk;
    mine.end = std::min(pairs, mine.begin + PairBatch::chunk);
    law.stiffness(mine, &stiffness[mine.begin]);
    for (std::size_t q = mine.begin; q < mine.end; ++q) {
      const Vec3 branch = s.branch(p.position()[s.pairs.i[q]], p.position()[s.pairs.j[q]]);
      counts[q] = !(branch.norm() <= 0) && within_reach(s, q, p.position(), reach);
      if (!counts[q]) continue;
      damped = damped || stiffness[q].damping > 0 || stiffness[q].shear_damping > 0;
      moments = moments || stiffness[q].bending > 0 || stiffness[q].torsion > 0;
    }
  }
  damped_ = any_rank(link, damped);
  moments_ = any_rank(link, moments);
  start_.assign(n + 1, 0);
  for (std::size_t q = 0; q < pairs; ++q)
    if (counts[q]) {
      ++start_[s.pairs.i[q] + 1];
      ++start_[s.pairs.j[q] + 1];
    }
  for (const WallTouch& t : s.wall_touches) start_[t.particle + 1] += within_reach(s, t, reach);
  for (std::size_t a = 0; a < n; ++a) start_[a + 1] += start_[a];
  ends_.resize(start_[n]);
  std::vector<std::size_t> next(start_.begin() + 1, start_.end());  // walls fill each row from its end
  for (const WallTouch& t : s.wall_touches)
    if (within_reach(s, t, reach)) ends_[--next[t.particle]] = {end_of(s, t), Index(n)};
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t a = 0; a < n; ++a) {
    inverse_mass_[a] = 1 / p.mass()[a];
    inverse_inertia_[a] = 1 / p.inertia()[a];
    std::size_t at = start_[a];
    for (std::size_t e = in.start[a]; e < in.start[a + 1]; ++e) {
      const std::size_t q = in.entry[e] >> 1;
      const bool second = in.entry[e] & 1;
      if (counts[q]) ends_[at++] = {end_of(s, q, second, stiffness[q]), second ? s.pairs.i[q] : s.pairs.j[q]};
    }
  }
}

void StiffnessOperator::row(std::size_t a, const Vec6* u, Vec6& k, Vec6& c) const {
  double load[6] = {}, drag[6] = {};
  const double* own = u[a].data();
  for (std::size_t e = start_[a]; e < start_[a + 1]; ++e) {
    const double* other = u[ends_[e].other].data();
    add_resistance(load, ends_[e].end, own, other);
    if (moments_) add_moment_resistance(load, ends_[e].end, own, other);
    if (damped_) add_damping_resistance(drag, ends_[e].end, own, other);
  }
  for (int d = 0; d < 6; ++d) {
    const double inverse = inverse_mass(a, d);
    k[d] = inverse * load[d];
    if (damped_) c[d] = inverse * drag[d];
  }
}

}  // namespace breccia
