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

Direction direction_of(const CameraConfig& camera, const TestSetup& setup, bool face) {
  Vec3 toward = -Vec3::UnitY(), up = Vec3::UnitZ();
  if (setup.dimension == 2) {
    toward = Vec3::UnitZ();
    up = Vec3::UnitY();
  } else if (camera.direction) {
    toward = camera.direction->normalized();
  } else {
    switch (camera.view.value_or(face ? Looking::face : Looking::oblique)) {
      case Looking::oblique: {
        constexpr double azimuth = -60 * pi / 180, elevation = 18 * pi / 180;
        toward = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                  std::sin(elevation)};
        break;
      }
      case Looking::face:
        toward = setup.face;
        up = setup.up;
        break;
      case Looking::front:
        break;
      case Looking::side:
        toward = Vec3::UnitX();
        break;
      case Looking::top:
        toward = Vec3::UnitZ();
        break;
    }
  }
  up = camera.up.value_or(up);
  up -= up.dot(toward) * toward;
  if (!(up.norm() > 1e-6)) up = Vec3::UnitY() - toward.y() * toward;
  return {toward, up.normalized()};
}

std::vector<Slab> slabs_of(const TestSetup& setup) {
  std::vector<Slab> slabs;
  if (!setup.specimen) return slabs;
  const SpecimenShape& s = *setup.specimen;
  const Vec3 centre = s.base + 0.5 * s.height * s.axis;
  for (const Platen& p : setup.platens) {
    const double thickness = 0.025 * setup.size();
    int along = 0;
    p.normal.cwiseAbs().maxCoeff(&along);
    Vec3 sides[2];
    for (int k = 1; k < 3; ++k) {
      const int axis = (along + k) % 3;
      sides[k - 1] = (setup.dimension == 2 && axis == 2 ? 0.5 : 0.55) * s.extent[axis] * Vec3::Unit(axis);
    }
    const Vec3 face = centre - (centre - p.point).dot(p.normal) * p.normal;
    slabs.push_back({face - thickness * p.normal, sides[0], sides[1], thickness * Vec3::Unit(along)});
  }
  return slabs;
}

Viewpoint::Viewpoint(const Spheres& spheres, const TestSetup& setup, const Direction& direction, double zoom,
                     bool platens)
    : dimension_(setup.dimension), direction_(direction), right_(direction.up.cross(direction.toward)) {
  BRECCIA_ASSERT(!spheres.position.empty());
  constexpr double far = std::numeric_limits<double>::infinity();
  low_ = Vec3::Constant(far);
  high_ = Vec3::Constant(-far);

  Vec3 box_low = Vec3::Constant(-far), box_high = Vec3::Constant(far);
  if (setup.specimen) {
    const SpecimenShape& s = *setup.specimen;
    // A slender beam bends by more than a tenth of its depth.
    const Vec3 room = setup.held.empty() ? Vec3(0.1 * s.extent) : Vec3::Constant(0.1 * setup.size()),
               centre = s.base + 0.5 * s.height * s.axis, half = 0.5 * s.extent + room;
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
  if (setup.specimen) include(*setup.specimen);
  if (platens)
    for (const Slab& s : slabs_of(setup))
      for (int c = 0; c < 8; ++c)
        include(s.centre + (c & 1 ? s.a : Vec3(-s.a)) + (c & 2 ? s.b : Vec3(-s.b)) + (c & 4 ? s.c : Vec3(-s.c)), 0);
  if (setup.specimen)
    for (const DeadLoad& l : setup.loads)
      if (frames(l.tip, 0)) include(l.tip - 1.1 * arrow_share * setup.size() * l.direction, 0);
  // A single point, or points in a row: some room about them.
  const double size = std::max({high_.x() - low_.x(), high_.y() - low_.y(), 1e-9});
  for (int k = 0; k < 2; ++k)
    if (!(high_[k] - low_[k] > 1e-6 * size)) {
      low_[k] -= 0.5 * size;
      high_[k] += 0.5 * size;
    }
  for (int k = 0; k < 2; ++k) {
    const double middle = 0.5 * (low_[k] + high_[k]), half = 0.5 * (high_[k] - low_[k]) / zoom;
    low_[k] = middle - half;
    high_[k] = middle + half;
  }
}

void Viewpoint::include(const Vec3& x, double radius) {
  const Vec3 seen(right_.dot(x), direction_.up.dot(x), direction_.toward.dot(x)), r = Vec3::Constant(radius);
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
  for (const Vec3& d : {right_, direction_.up, direction_.toward}) {
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
  const double across = right_.dot(x), along = direction_.up.dot(x), reach = radius - tiny;
  return across - reach >= low_.x() && across + reach <= high_.x() && along - reach >= low_.y() &&
         along + reach <= high_.y();
}

Viewpoint::Paper Viewpoint::paper(int size, bool titled) const {
  const double aspect = (high_.x() - low_.x()) / (high_.y() - low_.y()), usable = usable_height - (titled ? 5 : 0);
  constexpr double widest = 160, least_height = 52, sides = left_margin + right_margin;
  const double unit = size / 100.0, width = std::clamp(usable * aspect + sides, 65.0, widest);
  // What is much wider than high, a beam, needs a sheet that is less high.
  const double needed = (widest - sides) / aspect + 100 - usable;
  const double height = usable * aspect + sides > widest ? std::clamp(needed, least_height, 100.0) : 100.0;
  return {int(std::lround(unit * width)), int(std::lround(unit * height)), unit};
}

Projection Viewpoint::aim(const Paper& paper, bool titled) {
  const double u = paper.unit, usable_width = paper.width - (left_margin + right_margin) * u,
               high = paper.height - (top_margin + bottom_margin + (titled ? 5 : 0)) * u;
  pixels_per_metre_ = std::min(high / (high_.y() - low_.y()), usable_width / (high_.x() - low_.x()));
  const double x = left_margin * u + 0.5 * usable_width, y = bottom_margin * u + 0.5 * high;
  const Vec3 middle = 0.5 * (low_ + high_);
  return {right_,
          direction_.up,
          direction_.toward,
          pixels_per_metre_,
          {x - pixels_per_metre_ * middle.x(), y - pixels_per_metre_ * middle.y()}};
}

void Viewpoint::annotate(Overlay& overlay, bool directions) const {
  BRECCIA_ASSERT(pixels_per_metre_ > 0);
  // No longer than is free beside the time.
  const double free = (0.45 * overlay.width) / pixels_per_metre_;
  const double longest = std::min(0.25 * (high_.x() - low_.x()) + 0.25 * (high_.y() - low_.y()), free);
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  double length = power;
  for (const double s : {2.0, 5.0})
    if (s * power <= longest) length = s * power;
  overlay.scale_bar = length * pixels_per_metre_;
  const ShownUnit unit = shown_unit("m", length * 1.0001);
  overlay.scale_text = significant(length * unit.factor, 3) + " " + unit.unit;
  if (!directions) return;
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < dimension_; ++k)
    overlay.directions.emplace_back(Eigen::Vector2d(right_[k], direction_.up[k]), names[k]);
}

}  // namespace breccia::pictures
