// SPDX-License-Identifier: BSD-3-Clause
/// The space that is packed, whatever bounds it.
#pragma once

#include <memory>

#include "breccia/packing_tools/container.hpp"

namespace breccia::collective_rearrangement {

/// Where a sphere was put.
struct Confined {
  Vec3 x;       ///< centre [m]
  double room;  ///< it keeps inside while it moves less than this; negative when no place for it was found [m]
};

class Region {
 public:
  virtual ~Region() = default;
  virtual double measure() const = 0;         ///< volume [m3]; area in two dimensions [m2]
  virtual double largest_radius() const = 0;  ///< no larger sphere can fit [m]
  virtual SpecimenShape::Outline outline() const = 0;
  virtual Vec3 axis() const = 0;
  /// A place for the centre of a sphere of radius r [m], from three numbers in [0, 1). UserError when none is found.
  virtual Vec3 place(double r, double a, double b, double c) const = 0;
  /// A bit for each wall that is at most (1 + gap) r away.
  virtual unsigned walls_near(const Vec3& x, double r, double gap) const = 0;
  /// The centre nearest to x at which a sphere of radius r [m] keeps inside and touches the walls of these bits.
  virtual Confined confine(const Vec3& x, double r, unsigned touching) const = 0;
  /// How far inside a point is; negative outside [m].
  virtual double depth(const Vec3& x) const = 0;
  /// Grown outward by a margin [m], flat ends only if `ends`; in the same coordinates.
  virtual std::unique_ptr<Region> grown(double margin, bool ends) const = 0;
};

/// A container, moved so that what grows from it keeps the coordinates of the original.
class ContainerRegion final : public Region {
 public:
  explicit ContainerRegion(const Container& c, const Vec3& origin = Vec3::Zero()) : container_(c), origin_(origin) {}
  double measure() const override { return container_.measure(); }
  double largest_radius() const override { return container_.largest_radius(); }
  SpecimenShape::Outline outline() const override { return container_.outline(); }
  Vec3 axis() const override { return container_.axis(); }
  Vec3 place(double r, double a, double b, double c) const override { return origin_ + container_.place(r, a, b, c); }
  unsigned walls_near(const Vec3& x, double r, double gap) const override {
    Container::Walls walls;
    const std::size_t n = container_.walls(x - origin_, walls);
    unsigned bits = 0;
    for (std::size_t w = 0; w < n; ++w)
      if (walls[w].distance <= (1 + gap) * r) bits |= 1u << w;
    return bits;
  }
  Confined confine(const Vec3& x, double r, unsigned touching) const override {
    const Vec3 p = origin_ + container_.project(x - origin_, r, touching);
    return {p, depth(p) - r};
  }
  double depth(const Vec3& x) const override {
    Container::Walls walls;
    const std::size_t n = container_.walls(x - origin_, walls);
    double least = walls[0].distance;
    for (std::size_t w = 1; w < n; ++w) least = std::min(least, walls[w].distance);
    return least;
  }
  std::unique_ptr<Region> grown(double margin, bool ends) const override {
    const Vec3 d = container_.size();
    const bool flat = container_.dimension() == 2;
    // Of a cylinder and a box, the ends are those that the axis meets.
    Vec3 more = Vec3::Constant(2 * margin);
    if (!ends && container_.shape() != Container::Shape::sphere) more -= 2 * margin * axis();
    if (flat) more.z() = 0;
    const Vec3 n = d + more;
    const Vec3 origin = origin_ - (flat ? Vec3(0, 0.5 * more.y(), 0) : Vec3(0, 0, 0.5 * more.z()));
    switch (container_.shape()) {
      case Container::Shape::cylinder:
        return std::make_unique<ContainerRegion>(Container::cylinder(n.x(), n.z()), origin);
      case Container::Shape::sphere:
        return std::make_unique<ContainerRegion>(flat ? Container::disc(n.x()) : Container::sphere(n.x()), origin);
      default:
        return std::make_unique<ContainerRegion>(
            flat ? Container::rectangle(n.x(), n.y()) : Container::box(n.x(), n.y(), n.z()), origin);
    }
  }

 private:
  Container container_;
  Vec3 origin_;
};

}  // namespace breccia::collective_rearrangement
