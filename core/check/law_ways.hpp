// SPDX-License-Identifier: BSD-3-Clause
/// The ways on which single pairs are led when a law is checked.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "check/law_rig.hpp"

namespace breccia {

/// Where a pair along x is led, at the end of the way: j relative to i, in radii and radians.
struct Way {
  std::string name;
  Vec3 shift = Vec3::Zero();  ///< of j; across x it shears
  Vec3 turn_i = Vec3::Zero(), turn_j = Vec3::Zero();
  bool bonded = true;
};

constexpr double checked_radius = 1e-3;  ///< of the larger sphere, i [m]

/// In every direction, and in all at once; a pair without a bond is pressed. In two dimensions what of it lies in the
/// plane z = 0.
std::vector<Way> ways(bool bonded, int dimension);
std::string bonded_text(bool bonded);
/// The motion that leads the given share of a way in one step of `dt`; `amplitude`: of the way, in its units.
PairMotion motion(const Way& way, double amplitude, double share, double dt);
Vec3 random_direction(std::mt19937_64& random);
/// What is left of a vector, and of an axis of rotation, in two dimensions.
Vec3 in_plane(const Vec3& vector, int dimension);
Vec3 about_plane(const Vec3& axis, int dimension);

}  // namespace breccia
