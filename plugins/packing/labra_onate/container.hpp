// SPDX-License-Identifier: BSD-3-Clause
/// The space to be packed: a cylinder, a box, or (two dimensions) a rectangle.
#pragma once

#include <array>
#include <vector>

#include "breccia/types.hpp"

namespace breccia::labra_onate {

/// One wall as a sphere sees it.
struct WallDistance {
  double distance;   ///< of the centre [m]
  Vec3 inward;       ///< unit normal toward the inside: the gradient of the distance
};

class Container {
 public:
  /// Axis z, base centre at the origin [m].
  static Container cylinder(double diameter, double height);
  /// x and y centred, z from 0 [m].
  static Container box(double x, double y, double z);
  /// In the plane z = 0: x centred, y from 0 [m].
  static Container rectangle(double x, double y);

  int dimension() const { return dimension_; }
  bool round() const { return round_; }
  double measure() const;                   ///< volume [m3], or area [m2] in two dimensions
  const Vec3& size() const { return size_; }  ///< of the bounding box [m]
  double largest_radius() const;            ///< of a sphere that fits [m]

  /// A place for the centre of a sphere of radius r, from three numbers in [0, 1); uniform when they are.
  Vec3 place(double r, double a, double b, double c) const;

  static constexpr std::size_t max_walls = 6;
  /// All walls as seen from x, in a fixed order; returns how many. The curved wall has no normal on the axis: x's.
  std::size_t walls(const Vec3& x, std::array<WallDistance, max_walls>& out) const;

  /// The point nearest to x whose distance to every wall is at least r, and equal to r for the walls whose bit is set
  /// in `tangent`.
  Vec3 project(const Vec3& x, double r, unsigned tangent) const;

 private:
  int dimension_ = 3;
  bool round_ = false;
  Vec3 size_ = Vec3::Zero();
};

}  // namespace breccia::labra_onate
