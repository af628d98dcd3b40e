// SPDX-License-Identifier: BSD-3-Clause
#include "camera.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "breccia/error.hpp"

namespace breccia::pictures {
namespace {

// In hundredths of the picture's height.
constexpr double left_margin = 3, top_margin = 3, bottom_margin = 11.5, right_margin = 100 * Overlay::share_of_bar;
constexpr double usable_height = 100 - top_margin - bottom_margin;
using std::numbers::pi;

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
    }
    if (low_.x() < high_.x() && low_.y() < high_.y()) break;  // nothing inside the stated shape: frame all
  }
  if (facts.specimen) include(*facts.specimen);
  // A single point, or points in a row: some room about them.
  const double room = std::max({high_.x() - low_.x(), high_.y() - low_.y(), 1e-9});
  for (int k = 0; k < 2; ++k)
    if (!(high_[k] - low_[k] > 1e-6 * room)) {
      low_[k] -= 0.5 * room;
      high_[k] += 0.5 * room;
    }
}

void Viewpoint::include(const Vec3& x, double radius) {
  const Vec3 seen(right_.dot(x), up_.dot(x), toward_.dot(x)), r = Vec3::Constant(radius);
  low_ = low_.cwiseMin(seen - r);
  high_ = high_.cwiseMax(seen + r);
}

/// The outline that is drawn must not be cut off where the outermost particles leave some of it free.
void Viewpoint::include(const SpecimenShape& s) {
  using Outline = SpecimenShape::Outline;
  const Vec3 centre = s.base + 0.5 * s.height * s.axis, half = 0.5 * s.extent;
  if (s.outline == Outline::irregular) return;
  Vec3 low, high;  // along right, up, toward
  int k = 0;
  for (const Vec3& d : {right_, up_, toward_}) {
    double reach = d.cwiseAbs().dot(half);  // of the box
    if (s.outline == Outline::ellipsoid || (s.outline == Outline::cylinder && dimension_ == 2)) {
      reach = d.cwiseProduct(half).norm();
    } else if (s.outline == Outline::cylinder) {
      const double along = std::abs(d.dot(s.axis)), across = std::sqrt(std::max(0.0, 1 - along * along));
      Vec3 radial = s.axis.unitOrthogonal();
      reach = 0.5 * s.height * along + half.dot(radial.cwiseAbs()) * across;
    }
    low[k] = d.dot(centre) - reach;
    high[k++] = d.dot(centre) + reach;
  }
  low_ = low_.cwiseMin(low);
  high_ = high_.cwiseMax(high);
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

Projection Viewpoint::aim(int width, int height) {
  const double u = height / 100.0, usable_width = width - (left_margin + right_margin) * u;
  pixels_per_metre_ = std::min(usable_height * u / (high_.y() - low_.y()), usable_width / (high_.x() - low_.x()));
  const double x = left_margin * u + 0.5 * usable_width, y = (bottom_margin + 0.5 * usable_height) * u;
  const Vec3 middle = 0.5 * (low_ + high_);
  return {right_,
          up_,
          toward_,
          pixels_per_metre_,
          {x - pixels_per_metre_ * middle.x(), y - pixels_per_metre_ * middle.y()}};
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
