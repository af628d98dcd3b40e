// SPDX-License-Identifier: BSD-3-Clause
#include "container.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace breccia::labra_onate {

namespace {
/// Centre coordinate along a straight side [low, high] for a sphere of radius r; bit 0: touch low, bit 1: touch high.
double along_side(double x, double low, double high, double r, unsigned tangent) {
  if (tangent == 1) return low + r;
  if (tangent == 2) return high - r;
  if (tangent == 3) return x - low < high - x ? low + r : high - r;
  return std::max(low + r, std::min(high - r, x));
}
}  // namespace

Container Container::cylinder(double diameter, double height) {
  Container c;
  c.round_ = true;
  c.size_ = Vec3(diameter, diameter, height);
  return c;
}

Container Container::box(double x, double y, double z) {
  Container c;
  c.size_ = Vec3(x, y, z);
  return c;
}

Container Container::rectangle(double x, double y) {
  Container c;
  c.dimension_ = 2;
  c.size_ = Vec3(x, y, 0);
  return c;
}

double Container::measure() const {
  if (dimension_ == 2) return size_.x() * size_.y();
  return round_ ? std::numbers::pi / 4 * size_.x() * size_.x() * size_.z() : size_.prod();
}

double Container::largest_radius() const {
  return dimension_ == 2 ? 0.5 * std::min(size_.x(), size_.y()) : 0.5 * size_.minCoeff();
}

Vec3 Container::place(double r, double a, double b, double c) const {
  const Vec3 room = (size_ - Vec3::Constant(2 * r)).cwiseMax(0.0);
  if (dimension_ == 2) return {(a - 0.5) * room.x(), r + b * room.y(), 0};
  if (!round_) return {(a - 0.5) * room.x(), (b - 0.5) * room.y(), r + c * room.z()};
  const double rho = 0.5 * room.x() * std::sqrt(a), angle = 2 * std::numbers::pi * b;
  return {rho * std::cos(angle), rho * std::sin(angle), r + c * room.z()};
}

std::size_t Container::walls(const Vec3& x, std::array<WallDistance, max_walls>& out) const {
  std::size_t n = 0;
  if (round_) {
    const double rho = std::hypot(x.x(), x.y());
    const Vec3 inward = rho > 0 ? Vec3(-x.x() / rho, -x.y() / rho, 0) : Vec3(-1, 0, 0);
    out[n++] = {0.5 * size_.x() - rho, inward};
  } else {
    out[n++] = {x.x() + 0.5 * size_.x(), Vec3::UnitX()};
    out[n++] = {0.5 * size_.x() - x.x(), -Vec3::UnitX()};
    const double low = dimension_ == 2 ? 0.0 : -0.5 * size_.y();
    out[n++] = {x.y() - low, Vec3::UnitY()};
    out[n++] = {low + size_.y() - x.y(), -Vec3::UnitY()};
  }
  if (dimension_ == 3) {
    out[n++] = {x.z(), Vec3::UnitZ()};
    out[n++] = {size_.z() - x.z(), -Vec3::UnitZ()};
  }
  return n;
}

Vec3 Container::project(const Vec3& x, double r, unsigned tangent) const {
  Vec3 p = x;
  unsigned ends = tangent;
  if (round_) {
    const double reach = 0.5 * size_.x() - r, rho = std::hypot(x.x(), x.y());
    if (rho > reach || (tangent & 1u)) {
      if (rho > 0) { p.x() = x.x() * (reach / rho); p.y() = x.y() * (reach / rho); }
      else p.x() = reach;
    }
    ends = tangent >> 1;
  } else {
    const double low = dimension_ == 2 ? 0.0 : -0.5 * size_.y();
    p.x() = along_side(x.x(), -0.5 * size_.x(), 0.5 * size_.x(), r, tangent & 3u);
    p.y() = along_side(x.y(), low, low + size_.y(), r, (tangent >> 2) & 3u);
    ends = tangent >> 4;
  }
  p.z() = dimension_ == 2 ? 0.0 : along_side(x.z(), 0, size_.z(), r, ends & 3u);
  return p;
}

}  // namespace breccia::labra_onate
