// SPDX-License-Identifier: BSD-3-Clause
/// Takes the specimen out of a packing that was made larger.
#pragma once

#include "rearrangement.hpp"

namespace breccia::collective_rearrangement {

struct Cut {
  Spheres spheres;         ///< in the coordinates of the region
  double mean_number = 0;  ///< of spheres, over all places tried
};

/// The spheres whose centres lie in `region` at one of many places within half the margin [m]: the place that gives
/// exactly `wanted` spheres if there is one, or comes nearest, and among equals the one whose solid volume comes
/// nearest to `wanted_solid` [m3], in two dimensions area [m2]. Flat ends stay at the ends. The seed alone decides
/// which places are tried.
Cut cut_out(const Spheres& all, const Region& region, double margin, bool ends, int dimension, std::size_t wanted,
            double wanted_solid, std::uint64_t seed);

/// The spheres whose centres lie in `region` moved to `place` [m], in the coordinates of the region.
Spheres cut_at(const Spheres& all, const Region& region, const Vec3& place);

}  // namespace breccia::collective_rearrangement
