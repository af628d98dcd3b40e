// SPDX-License-Identifier: BSD-3-Clause
/// Measures a finished packing.
#pragma once

#include "config.hpp"
#include "rearrangement.hpp"

namespace breccia::collective_rearrangement {

struct Quality {
  double porosity = 0;                                                           ///< overlaps counted twice
  double radius_mean = 0, radius_deviation = 0, radius_min = 0, radius_max = 0;  // [m]
  double contacts = 0;                       ///< mean number of overlapping partners of a sphere
  double mean_overlap = 0, max_overlap = 0;  ///< of overlapping pairs, over the sum of the radii
  Vec3 fabric = Vec3::Zero();                ///< diagonal of <n (x) n> over the overlapping pairs
};

Quality measure(const Spheres& s, double region_measure, const Space& space);

}  // namespace breccia::collective_rearrangement
