// SPDX-License-Identifier: BSD-3-Clause
/// Measures of a specimen that come from its particles.
#pragma once

#include <span>

#include "breccia/views.hpp"

namespace breccia {

/// The cylinder or box that the spheres fill, measured from their surfaces: a cylinder's axis runs through the middle
/// of the bounding box, its radius is the farthest sphere surface from that axis.
SpecimenShape measure_specimen(std::span<const Vec3> position, std::span<const double> radius,
                               SpecimenShape::Outline outline, const Vec3& axis, int dimension, double thickness);

/// Sum of the particles' own volumes [m3]; overlaps count twice.
double solid_volume(std::span<const double> radius, int dimension, double thickness);

}  // namespace breccia
