// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <algorithm>

#include "breccia/images.hpp"

namespace breccia::collective_rearrangement {

Quality measure(const Spheres& s, double region_measure, const Space& space) {
  Quality q;
  q.porosity = 1 - solid_measure(s.r, space.dimension) / region_measure;
  q.radius_mean = detail::mean_of(s.r);
  q.radius_deviation = detail::deviation_of(s.r);
  q.radius_min = *std::min_element(s.r.begin(), s.r.end());
  q.radius_max = *std::max_element(s.r.begin(), s.r.end());
  std::size_t pairs = 0;
  for_each_pair_within(space, s.x, 2 * q.radius_max, [&](Index i, Index j) {
    const Vec3 d = space.branch(s.x[i], s.x[j]);
    const double overlap = 1 - d.norm() / (s.r[i] + s.r[j]);
    if (!(overlap > 0)) return;
    ++pairs;
    q.mean_overlap += overlap;
    q.max_overlap = std::max(q.max_overlap, overlap);
    if (d.squaredNorm() > 0) q.fabric += d.cwiseAbs2() / d.squaredNorm();
  });
  q.contacts = 2 * double(pairs) / double(s.size());
  if (pairs > 0) {
    q.mean_overlap /= double(pairs);
    q.fabric /= double(pairs);
  }
  return q;
}

}  // namespace breccia::collective_rearrangement
