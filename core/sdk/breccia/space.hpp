// SPDX-License-Identifier: BSD-3-Clause
/// The space that the particles live in: what is asked of it is asked here.
#pragma once

#include <cmath>
#include <numbers>

#include "breccia/types.hpp"

namespace breccia {

struct Space {
  int dimension = 3;
  double thickness = 1;  ///< out of plane, in two dimensions [m]

  /// Branch vector between two centres [m].
  Vec3 branch(const Vec3& from, const Vec3& to) const { return to - from; }
  /// Of a sphere, or of a disc as thick as the space [m3].
  double solid_volume(double radius) const {
    return dimension == 2 ? std::numbers::pi * radius * radius * thickness
                          : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  /// Polar moment of inertia over mass: of a sphere, or of a disc about its axis [m2].
  double gyration(double radius) const { return (dimension == 2 ? 0.5 : 0.4) * radius * radius; }
};

}  // namespace breccia
