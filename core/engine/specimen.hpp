// SPDX-License-Identifier: BSD-3-Clause
/// Measures of a specimen that come from its particles.
#pragma once

#include <span>

#include "breccia/views.hpp"
#include "engine/rank_link.hpp"

namespace breccia {

/// The cylinder or box that the spheres fill, measured from their surfaces: a cylinder's axis runs through the middle
/// of the bounding box, its radius is the farthest sphere surface from that axis. An irregular specimen has the volume
/// of its container [m3], or of its bounding box when that is not known (0). Where space repeats itself the cell's edge
/// counts in place of the particles' extent. `link`: these are a part of the specimen.
SpecimenShape measure_specimen(Strided<const Vec3> position, Strided<const double> radius,
                               SpecimenShape::Outline outline, const Vec3& axis, const Space& space,
                               double container_volume = 0, RankLink* link = nullptr);

/// Sum of the particles' own volumes [m3]; overlaps count twice.
double solid_volume(Strided<const double> radius, const Space& space);

}  // namespace breccia
