// SPDX-License-Identifier: BSD-3-Clause
/// What a picture leaves away: slices, clips and cutaways.
#pragma once

#include "scene_pictures.hpp"

namespace breccia::pictures {

/// Whether a point is seen, and where a plane cuts spheres.
class Cutting {
 public:
  Cutting(const SceneWish& wish, const TestSetup& setup, const Direction& direction, const Vec3& middle, double extent);

  bool shows_sphere(const Vec3& centre, double radius) const;
  bool shows_crack(const Vec3& x) const;

  /// Of cracks that hide each other: a slab in the middle of the specimen, square to the rays, as thick as this share
  /// of the specimen.
  void take_middle_slab(double share);

  /// Spheres are drawn as what this plane cuts of them.
  bool is_section() const { return slice_ && !thickness_; }
  const Vec3& point() const { return slice_point_; }
  const Vec3& normal() const { return slice_normal_; }
  /// Of the slab that cracks are shown of; 0: all of them [m].
  double crack_slab() const { return slice_ ? thickness_.value_or(0.15 * extent_) : 0; }

 private:
  bool clipped(const Vec3& x) const;

  bool slice_ = false, clip_ = false;
  std::optional<double> thickness_;
  Vec3 slice_point_ = Vec3::Zero(), slice_normal_ = Vec3::UnitZ(), clip_point_ = Vec3::Zero(),
       clip_normal_ = Vec3::UnitZ();
  Cut cut_;
  Vec3 middle_, toward_, front_, side_;
  double extent_;
};

}  // namespace breccia::pictures
