// SPDX-License-Identifier: BSD-3-Clause
#include "cutting.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace breccia::pictures {

Cutting::Cutting(const SceneWish& wish, const TestSetup& setup, const Direction& direction, const Vec3& middle,
                 double extent)
    : cut_(wish.cut), middle_(middle), toward_(direction.toward), extent_(extent) {
  if (cut_ == Cut::automatic) cut_ = setup.best_from_the_face ? Cut::half : Cut::quarter;
  // A quarter is taken out along what stands upright in the picture.
  const bool along_axis = setup.specimen && std::abs(setup.specimen->axis.dot(toward_)) < 0.9;
  const Vec3 upright = along_axis ? setup.specimen->axis : direction.up;
  front_ = (toward_ - toward_.dot(upright) * upright).normalized();
  side_ = upright.cross(front_);
  const auto plane = [&](const PlaneConfig& p, Vec3& point, Vec3& normal) {
    normal = p.normal ? p.normal->normalized() : toward_;
    point = middle + p.offset * normal;
  };
  if (wish.options.slice) {
    slice_ = true;
    thickness_ = wish.options.slice->thickness;
    plane(*wish.options.slice, slice_point_, slice_normal_);
  }
  if (wish.options.clip) {
    clip_ = true;
    plane(*wish.options.clip, clip_point_, clip_normal_);
  }
}

void Cutting::take_middle_slab(double share) {
  slice_ = true;
  thickness_ = share * extent_;
  slice_point_ = middle_;
  slice_normal_ = toward_;
}

bool Cutting::clipped(const Vec3& x) const { return clip_ && (x - clip_point_).dot(clip_normal_) > 0; }

bool Cutting::shows_sphere(const Vec3& centre, double radius) const {
  if (clipped(centre)) return false;
  if (slice_) {
    const double off = std::abs((centre - slice_point_).dot(slice_normal_));
    if (!(thickness_ ? off <= 0.5 * *thickness_ : off < radius)) return false;
  }
  if (cut_ == Cut::none) return true;
  const Vec3 x = centre - middle_;
  if (cut_ == Cut::half) return !(x.dot(front_) > 0);
  return !(x.dot(front_) > std::abs(x.dot(side_)));
}

bool Cutting::shows_crack(const Vec3& x) const {
  return !clipped(x) && (!slice_ || std::abs((x - slice_point_).dot(slice_normal_)) <= 0.5 * crack_slab());
}

}  // namespace breccia::pictures
