// SPDX-License-Identifier: BSD-3-Clause
/// The space that a packing fills: a cylinder, a box, a sphere, or (two dimensions) a rectangle or a disc. What a
/// workflow says of it, and what a sphere near its walls needs to know.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "breccia/packing.hpp"
#include "breccia/schema.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// One wall as a sphere sees it.
struct WallDistance {
  double distance;  ///< of the centre [m]
  Vec3 inward;      ///< unit normal toward the inside: the gradient of the distance
};

class Container {
 public:
  enum class Shape { cylinder, box, sphere };

  /// Axis z, base centre at the origin [m].
  static Container cylinder(double diameter, double height) {
    return {Shape::cylinder, 3, Vec3(diameter, diameter, height)};
  }
  /// x and y centred, z from 0 [m].
  static Container box(double x, double y, double z) { return {Shape::box, 3, Vec3(x, y, z)}; }
  /// x and y centred, z from 0 [m].
  static Container sphere(double diameter) { return {Shape::sphere, 3, Vec3::Constant(diameter)}; }
  /// In the plane z = 0: x centred, y from 0 [m].
  static Container rectangle(double x, double y) { return {Shape::box, 2, Vec3(x, y, 0)}; }
  static Container disc(double diameter) { return {Shape::sphere, 2, Vec3(diameter, diameter, 0)}; }

  /// The same box without its faces across these directions: space repeats itself there.
  Container opened(const std::array<bool, 3>& directions) const {
    BRECCIA_ASSERT(shape_ == Shape::box);
    Container c = *this;
    c.open_ = directions;
    return c;
  }

  Shape shape() const { return shape_; }
  int dimension() const { return dimension_; }
  const Vec3& size() const { return size_; }                   ///< of the bounding box [m]
  Vec3 low() const { return {-0.5 * size_.x(), low_y(), 0}; }  ///< its lower corner [m]

  /// Volume [m3], or area [m2] in two dimensions.
  double measure() const {
    const double bounding = dimension_ == 2 ? size_.x() * size_.y() : size_.prod();
    switch (shape_) {
      case Shape::cylinder:
        return std::numbers::pi / 4 * bounding;
      case Shape::sphere:
        return std::numbers::pi / (dimension_ == 2 ? 4 : 6) * bounding;
      default:
        return bounding;
    }
  }

  /// Of a sphere that fits [m].
  double largest_radius() const {
    Vec3 room = 0.5 * size_;
    for (int k = 0; k < dimension_; ++k)
      if (open_[std::size_t(k)]) room[k] *= 0.5;  // a sphere must not meet its own image
    return dimension_ == 2 ? std::min(room.x(), room.y()) : room.minCoeff();
  }

  SpecimenShape::Outline outline() const {
    switch (shape_) {
      case Shape::cylinder:
        return SpecimenShape::Outline::cylinder;
      case Shape::sphere:
        return SpecimenShape::Outline::ellipsoid;
      default:
        return SpecimenShape::Outline::box;
    }
  }

  /// Of a cylinder; else the long direction, of equally long ones the last.
  Vec3 axis() const {
    int at = dimension_ - 1;
    if (shape_ != Shape::cylinder)
      for (int k = at - 1; k >= 0; --k)
        if (size_[k] > size_[at]) at = k;
    return Vec3::Unit(at);
  }

  /// A place for the centre of a sphere of radius r, from three numbers in [0, 1); uniform when they are.
  Vec3 place(double r, double a, double b, double c) const {
    const Vec3 wall(open_[0] ? 0 : r, open_[1] ? 0 : r, open_[2] ? 0 : r), room = (size_ - 2 * wall).cwiseMax(0.0);
    const double angle = 2 * std::numbers::pi * b;
    if (shape_ == Shape::sphere) {
      const double rho = 0.5 * room.x() * (dimension_ == 2 ? std::sqrt(a) : std::cbrt(a));
      if (dimension_ == 2) return round_centre() + rho * Vec3(std::cos(angle), std::sin(angle), 0);
      const double z = 2 * c - 1, across = std::sqrt(1 - z * z);
      return round_centre() + rho * Vec3(across * std::cos(angle), across * std::sin(angle), z);
    }
    if (dimension_ == 2) return {(a - 0.5) * room.x(), wall.y() + b * room.y(), 0};
    if (shape_ == Shape::box) return {(a - 0.5) * room.x(), (b - 0.5) * room.y(), wall.z() + c * room.z()};
    const double rho = 0.5 * room.x() * std::sqrt(a);
    return {rho * std::cos(angle), rho * std::sin(angle), r + c * room.z()};
  }

  static constexpr std::size_t max_walls = 6;
  using Walls = std::array<WallDistance, max_walls>;

  /// All walls as seen from x, in a fixed order; returns how many. A curved wall has no normal on the axis: x's. A face
  /// that is open is endlessly far away.
  std::size_t walls(const Vec3& x, Walls& out) const {
    std::size_t n = 0;
    if (shape_ == Shape::box) {
      out[n++] = {x.x() + 0.5 * size_.x(), Vec3::UnitX()};
      out[n++] = {0.5 * size_.x() - x.x(), -Vec3::UnitX()};
      const double low = low_y();
      out[n++] = {x.y() - low, Vec3::UnitY()};
      out[n++] = {low + size_.y() - x.y(), -Vec3::UnitY()};
    } else {
      const Vec3 arm = from_round_centre(x);
      const double rho = arm.norm();
      out[n++] = {0.5 * size_.x() - rho, rho > 0 ? Vec3(-arm / rho) : Vec3(-1, 0, 0)};
    }
    if (has_flat_ends()) {
      out[n++] = {x.z(), Vec3::UnitZ()};
      out[n++] = {size_.z() - x.z(), -Vec3::UnitZ()};
    }
    if (shape_ == Shape::box)
      for (std::size_t w = 0; w < n; ++w)
        if (open_[w / 2]) out[w].distance = std::numeric_limits<double>::infinity();
    return n;
  }

  /// Number of the lower end among the walls, the upper one being next; none for a sphere.
  std::optional<std::size_t> lower_end() const {
    if (shape_ == Shape::sphere) return std::nullopt;
    return shape_ == Shape::cylinder ? 1 : dimension_ == 2 ? 2 : 4;
  }

  /// The point nearest to x whose distance to every wall is at least r, and equal to r for the walls whose bit is set
  /// in `tangent`.
  Vec3 project(const Vec3& x, double r, unsigned tangent) const {
    Vec3 p = x;
    unsigned ends = tangent >> 1;
    if (shape_ == Shape::box) {
      const double low = low_y();
      if (!open_[0]) p.x() = along_side(x.x(), -0.5 * size_.x(), 0.5 * size_.x(), r, tangent & 3u);
      if (!open_[1]) p.y() = along_side(x.y(), low, low + size_.y(), r, (tangent >> 2) & 3u);
      ends = tangent >> 4;
    } else {
      const double reach = 0.5 * size_.x() - r;
      const Vec3 arm = from_round_centre(x);
      const double rho = arm.norm();
      if (rho > reach || (tangent & 1u)) p += rho > 0 ? Vec3(arm * (reach / rho - 1)) : Vec3(reach, 0, 0);
    }
    if (has_flat_ends() && !open_[2]) p.z() = along_side(p.z(), 0, size_.z(), r, ends & 3u);
    else if (dimension_ == 2) p.z() = 0.0;
    return p;
  }

 private:
  Container(Shape shape, int dimension, const Vec3& size) : shape_(shape), dimension_(dimension), size_(size) {}

  bool has_flat_ends() const { return dimension_ == 3 && shape_ != Shape::sphere; }
  double low_y() const { return dimension_ == 2 ? 0.0 : -0.5 * size_.y(); }
  Vec3 round_centre() const { return dimension_ == 2 ? Vec3(0, 0.5 * size_.y(), 0) : Vec3(0, 0, 0.5 * size_.z()); }
  /// From the centre of a sphere or disc, or from the axis of a cylinder.
  Vec3 from_round_centre(const Vec3& x) const {
    return shape_ == Shape::cylinder ? Vec3(x.x(), x.y(), 0) : Vec3(x - round_centre());
  }
  /// Centre coordinate along a straight side [low, high] for a sphere of radius r; bit 0: touch low, bit 1: touch high.
  static double along_side(double x, double low, double high, double r, unsigned tangent) {
    if (tangent == 1) return low + r;
    if (tangent == 2) return high - r;
    if (tangent == 3) return x - low < high - x ? low + r : high - r;
    return std::max(low + r, std::min(high - r, x));
  }

  Shape shape_;
  int dimension_;
  Vec3 size_;
  std::array<bool, 3> open_{};
};

/// What a workflow says of a container.
struct ContainerConfig {
  Container::Shape shape = Container::Shape::cylinder;
  std::optional<double> diameter, height;   // [m]
  std::optional<std::vector<double>> size;  // [m]

  static void describe(Schema<ContainerConfig>& s) {
    s.param("shape", &ContainerConfig::shape)
        .choice("cylinder", Container::Shape::cylinder, "axis z, centre of the base at the origin")
        .choice("box", Container::Shape::box, "x and y centred, z from 0; in two dimensions x centred, y from 0")
        .choice("sphere", Container::Shape::sphere,
                "x and y centred, z from 0; in two dimensions a disc: x centred, y from 0")
        .doc("what the particles fill");
    s.param("diameter", &ContainerConfig::diameter)
        .unit("m")
        .above(0)
        .example("23 mm")
        .doc("of the cylinder or sphere");
    s.param("height", &ContainerConfig::height).unit("m").above(0).example("46 mm").doc("of the cylinder");
    s.param("size", &ContainerConfig::size)
        .unit("m")
        .items(2, 3)
        .example("[50 mm, 50 mm, 100 mm]")
        .doc("of the box along x, y, z; the third is not needed in two dimensions");
  }

  /// UserError when it is not whole or does not suit the dimension.
  Container make(int dimension) const {
    if (shape == Container::Shape::cylinder) {
      if (dimension == 2)
        throw UserError("a cylinder cannot be packed in two dimensions: use a box with size: [width, height]");
      if (!diameter || !height || size)
        throw UserError("a cylinder is given by diameter and height, and by nothing else");
      return Container::cylinder(*diameter, *height);
    }
    if (shape == Container::Shape::sphere) {
      if (!diameter || height || size) throw UserError("a sphere is given by diameter, and by nothing else");
      return dimension == 2 ? Container::disc(*diameter) : Container::sphere(*diameter);
    }
    if (!size || diameter || height) throw UserError("a box is given by size, and by nothing else");
    for (const double x : *size)
      if (!(x > 0)) throw UserError("every entry of size must be above zero");
    if (dimension == 2) return Container::rectangle((*size)[0], (*size)[1]);
    if (size->size() < 3) throw UserError("a box in three dimensions needs three entries in size: [x, y, z]");
    return Container::box((*size)[0], (*size)[1], (*size)[2]);
  }

  /// For checks before the dimension is known.
  Container make() const { return make(shape == Container::Shape::box && size && size->size() == 2 ? 2 : 3); }
};

/// `Packing::why_not` of one that fills a container.
inline std::string why_not_in(const ContainerConfig& container, const PackingRequest& request) {
  try {
    if (container.make(request.dimension).shape() != Container::Shape::box && request.repeats())
      return "a space that repeats itself (`periodic`) is filled by a box: use `shape: box`";
    return {};
  } catch (const UserError& e) { return e.what(); }
}

}  // namespace breccia
