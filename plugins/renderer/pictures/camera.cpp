// SPDX-License-Identifier: BSD-3-Clause
#include "camera.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

// In hundredths of the picture's height.
constexpr double left_margin = 3, top_margin = 3, bottom_margin = 11.5, right_margin = 100 * Overlay::share_of_bar;
constexpr double usable_height = 100 - top_margin - bottom_margin;
constexpr double pi = 3.14159265358979323846;

}  // namespace

Viewpoint::Viewpoint(const Spheres& spheres, const FrameFacts& facts) : dimension_(facts.dimension) {
  BRECCIA_ASSERT(!spheres.position.empty());
  if (dimension_ == 2) {
    toward_ = Vec3::UnitZ();
    up_ = Vec3::UnitY();
  } else {
    constexpr double azimuth = -60 * pi / 180, elevation = 18 * pi / 180;
    toward_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
    up_ = (Vec3::UnitZ() - toward_.z() * toward_).normalized();
  }
  right_ = up_.cross(toward_);
  constexpr double far = std::numeric_limits<double>::infinity();
  low_ = Vec3::Constant(far);
  high_ = Vec3::Constant(-far);
  nearest_ = -far;
  farthest_ = far;

  Vec3 box_low = Vec3::Constant(-far), box_high = Vec3::Constant(far);
  if (facts.specimen) {
    const SpecimenShape& s = *facts.specimen;
    const Vec3 centre = s.base + 0.5 * s.height * s.axis, half = 0.6 * s.extent;
    box_low = centre - half;
    box_high = centre + half;
    if (dimension_ == 2) {
      box_low.z() = -far;
      box_high.z() = far;
    }
  }
  for (const bool all : {false, true}) {
    for (std::size_t p = 0; p < spheres.position.size(); ++p) {
      const Vec3& x = spheres.position[p];
      const bool inside = (x.array() >= box_low.array()).all() && (x.array() <= box_high.array()).all();
      if (inside || all) include(x, spheres.radius[p]);
      nearest_ = std::max(nearest_, toward_.dot(x) + spheres.radius[p]);
      farthest_ = std::min(farthest_, toward_.dot(x) - spheres.radius[p]);
    }
    if (low_.x() < high_.x()) break;  // nothing inside the stated shape: frame all
  }
}

void Viewpoint::include(const Vec3& x, double radius) {
  const Vec3 seen(right_.dot(x), up_.dot(x), toward_.dot(x)), r = Vec3::Constant(radius);
  low_ = low_.cwiseMin(seen - r);
  high_ = high_.cwiseMax(seen + r);
}

bool Viewpoint::frames(const Vec3& x, double radius) const {
  const double tiny = 1e-9 * (high_ - low_).norm();  // the outermost spheres make the frame
  const double across = right_.dot(x), along = up_.dot(x), reach = radius - tiny;
  return across - reach >= low_.x() && across + reach <= high_.x() && along - reach >= low_.y() &&
         along + reach <= high_.y();
}

int Viewpoint::width_for(int height) const {
  const double aspect = (high_.x() - low_.x()) / (high_.y() - low_.y());
  return int(
      std::lround(height / 100.0 * std::clamp(usable_height * aspect + left_margin + right_margin, 65.0, 160.0)));
}

void Viewpoint::aim(vtkRenderer* renderer, int width, int height) {
  const double u = height / 100.0, usable_width = width - (left_margin + right_margin) * u;
  pixels_per_metre_ = std::min(usable_height * u / (high_.y() - low_.y()), usable_width / (high_.x() - low_.x()));
  const double x = left_margin * u + 0.5 * usable_width, y = (bottom_margin + 0.5 * usable_height) * u;
  const Vec3 middle = 0.5 * (low_ + high_);
  const Vec3 focus = (middle.x() + (0.5 * width - x) / pixels_per_metre_) * right_ +
                     (middle.y() + (0.5 * height - y) / pixels_per_metre_) * up_ + middle.z() * toward_;
  const double size = (high_ - low_).norm(), distance = nearest_ - middle.z() + size;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.5 * height / pixels_per_metre_);
  camera->SetFocalPoint(focus.data());
  const Vec3 eye = focus + distance * toward_;
  camera->SetPosition(eye.data());
  camera->SetViewUp(up_.data());
  // By hand: the sphere mapper leaves the radii out of its bounds.
  camera->SetClippingRange(0.5 * size, distance + middle.z() - farthest_ + 0.5 * size);
}

void Viewpoint::annotate(Overlay& overlay) const {
  BRECCIA_ASSERT(pixels_per_metre_ > 0);
  const double longest = 0.25 * (high_.x() - low_.x()) + 0.25 * (high_.y() - low_.y());
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  double length = power;
  for (const double s : {2.0, 5.0})
    if (s * power <= longest) length = s * power;
  overlay.scale_bar = length * pixels_per_metre_;
  const ShownUnit unit = shown_unit("m", length * 1.0001);
  overlay.scale_text = significant(length * unit.factor, 3) + " " + unit.unit;
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < dimension_; ++k) overlay.directions.emplace_back(Eigen::Vector2d(right_[k], up_[k]), names[k]);
}

}  // namespace breccia::pictures
