// SPDX-License-Identifier: BSD-3-Clause
/// The space that the particles live in: what is asked of it is asked here.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "breccia/archive.hpp"
#include "breccia/types.hpp"

namespace breccia {

/// The nearest whole number; halves go to the even one. For |x| < 2^51. Without a call, so that loops over it
/// vectorise.
inline double nearest_whole(double x) {
  constexpr double shift = 0x1.8p52;
  return (x + shift) - shift;
}

/// How space repeats itself: a particle at x is also at x + V n, with whole numbers n.
class Cell {
 public:
  Cell() = default;
  /// Columns: the vectors by which space repeats itself; zero where it does not. The others are linearly independent.
  explicit Cell(const Mat3& vectors) : vectors_(vectors) {
    Mat3 full = vectors;
    for (int k = 0; k < 3; ++k) {
      repeats_[std::size_t(k)] = !vectors.col(k).isZero(0);
      if (!repeats_[std::size_t(k)]) full.col(k) = Vec3::Unit(k);
    }
    const Vec3 a = full.col(0), b = full.col(1), c = full.col(2);
    const double volume = a.dot(b.cross(c));
    if (repeats(0)) inverse_.row(0) = b.cross(c) / volume;
    if (repeats(1)) inverse_.row(1) = c.cross(a) / volume;
    if (repeats(2)) inverse_.row(2) = a.cross(b) / volume;
  }
  /// A box of these edges [m]; zero where space does not repeat itself.
  static Cell box(const Vec3& edges) { return edges.isZero(0) ? Cell() : Cell(Mat3(edges.asDiagonal())); }

  bool repeats() const { return repeats_[0] || repeats_[1] || repeats_[2]; }
  bool repeats(int direction) const { return repeats_[std::size_t(direction)]; }
  const Mat3& vectors() const { return vectors_; }  // [m]
  const Mat3& inverse() const { return inverse_; }  ///< rows: cells per length along each vector, else zero [1/m]
  /// By how many cells `difference` of two positions is longer than it need be.
  Vec3 cells(const Vec3& difference) const { return (inverse_ * difference).unaryExpr(&nearest_whole); }
  /// Distance of the two faces that the cell's vector `k` joins [m]: what is nearer than half of it has one image
  /// there.
  double width(int k) const { return 1 / inverse_.row(k).norm(); }
  void archive(Archive& archive) {
    archive("vectors", vectors_);
    if (archive.reading()) *this = Cell(Mat3(vectors_));
  }

 private:
  Mat3 vectors_ = Mat3::Zero(), inverse_ = Mat3::Zero();
  std::array<bool, 3> repeats_{};
};

struct Space {
  int dimension = 3;
  double thickness = 1;  ///< out of plane, in two dimensions [m]
  Cell cell = {};        ///< repeats itself nowhere, if not said

  /// Branch vector between two centres, to the nearest image of the second [m].
  Vec3 branch(const Vec3& from, const Vec3& to) const {
    const Vec3 difference = to - from;
    return cell.repeats() ? Vec3(difference - cell.vectors() * cell.cells(difference)) : difference;
  }
  /// Whether it repeats itself in all of its directions.
  bool repeats_all_round() const { return cell.repeats(0) && cell.repeats(1) && (dimension == 2 || cell.repeats(2)); }
  /// Of the cell, if it repeats itself in all of its directions [m3].
  double cell_volume() const {
    const Mat3& v = cell.vectors();
    const Vec3 across = v.col(0).cross(v.col(1));
    return dimension == 2 ? thickness * std::abs(across.z()) : std::abs(across.dot(v.col(2)));
  }
  /// Of a sphere, or of a disc as thick as the space [m3].
  double solid_volume(double radius) const {
    return dimension == 2 ? std::numbers::pi * radius * radius * thickness
                          : 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  }
  /// Polar moment of inertia over mass: of a sphere, or of a disc about its axis [m2].
  double gyration(double radius) const { return (dimension == 2 ? 0.5 : 0.4) * radius * radius; }
};

}  // namespace breccia
