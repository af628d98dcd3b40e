// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace breccia::pictures {
namespace {

using std::numbers::pi;
constexpr Rgb edge_colour{115, 115, 115}, wall_colour{243, 243, 243}, platen_colour{176, 184, 190},
    rim_colour{45, 45, 45};

/// Two unit vectors that make a right-handed frame with n.
std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3 a = n.cross(Vec3::Unit(least)).normalized();
  return {a, n.cross(a)};
}

/// A line as a strip that lies square to the rays along its whole length.
void add_line(Scene& scene, const Vec3& from, const Vec3& to, const Projection& view, double width) {
  const Vec3 way = 0.5 * (to - from), across = view.toward.cross(way);
  if (!(across.norm() > 1e-9 * way.norm())) return;  // seen from its end
  // Longer by half its width: no gaps where lines meet at an angle.
  const Vec3 half = way * (1 + 0.25 * width / way.norm());
  scene.patches.push_back(
      {0.5 * (from + to), half, 0.5 * width * across.normalized(), false, false, false, edge_colour});
}

void add_wall(Scene& scene, const Vec3& centre, const Vec3& a, const Vec3& b, bool round) {
  scene.patches.push_back({centre, a, b, round, false, true, wall_colour});
}

/// centre + cos t a + sin t b.
void add_ellipse(Scene& scene, const Vec3& centre, const Vec3& a, const Vec3& b, const Projection& view, double width) {
  constexpr int sides = 180;
  const auto at = [&](int k) -> Vec3 {
    return centre + std::cos(2 * pi * k / sides) * a + std::sin(2 * pi * k / sides) * b;
  };
  for (int k = 0; k < sides; ++k) add_line(scene, at(k), at(k + 1), view, width);
}

void add_box(Scene& scene, const Vec3& centre, const Vec3& half, const Projection& view, double width) {
  for (int k = 0; k < 3; ++k)  // all six faces: those in front are behind everything, too
    for (const double side : {-1.0, 1.0})
      add_wall(scene, centre + side * half[k] * Vec3::Unit(k), half[(k + 1) % 3] * Vec3::Unit((k + 1) % 3),
               half[(k + 2) % 3] * Vec3::Unit((k + 2) % 3), false);
  const auto corner = [&](int c) -> Vec3 {
    return centre + Vec3(c & 1 ? half.x() : -half.x(), c & 2 ? half.y() : -half.y(), c & 4 ? half.z() : -half.z());
  };
  for (int c = 0; c < 8; ++c)
    for (const int bit : {1, 2, 4})
      if (!(c & bit)) add_line(scene, corner(c), corner(c | bit), view, width);
}

void add_cylinder(Scene& scene, const SpecimenShape& s, const Projection& view, double width) {
  const auto [a, b] = tangents(s.axis);
  const double radius = 0.5 * s.extent.dot(a.cwiseAbs());
  const Vec3 top = s.base + s.height * s.axis;
  for (const Vec3& end : {s.base, top}) {
    add_wall(scene, end, radius * a, radius * b, true);
    add_ellipse(scene, end, radius * a, radius * b, view, width);
  }
  const Vec3 side = view.toward.cross(s.axis);  // where the rays touch the barrel
  if (!(side.norm() > 1e-9)) return;
  const Vec3 out = radius * side.normalized();
  add_wall(scene, 0.5 * (s.base + top), out, 0.5 * s.height * s.axis, false);
  for (const double k : {-1.0, 1.0}) add_line(scene, s.base + k * out, top + k * out, view, width);
}

void add_ellipsoid(Scene& scene, const Vec3& centre, const Vec3& half, const Projection& view, double width) {
  // The rays touch the ellipsoid where its normal, and so the point of the unit sphere divided by the half axes, is
  // square to them.
  const auto [a, b] = tangents(view.toward.cwiseQuotient(half).normalized());
  const Vec3 u = a.cwiseProduct(half), v = b.cwiseProduct(half);
  add_wall(scene, centre, u, v, true);
  add_ellipse(scene, centre, u, v, view, width);
}

}  // namespace

void add_spheres(Scene& scene, const Spheres& spheres, const std::vector<Rgb>& colour) {
  for (std::size_t p = 0; p < spheres.size(); ++p)
    scene.spheres.push_back({spheres.position[p], spheres.radius[p], colour[p]});
}

void add_section(Scene& scene, const Spheres& spheres, const std::vector<Rgb>& colour, const Vec3& point,
                 const Vec3& normal) {
  const auto [a, b] = tangents(normal);
  for (std::size_t p = 0; p < spheres.size(); ++p) {
    const double off = (spheres.position[p] - point).dot(normal), square = spheres.radius[p] * spheres.radius[p];
    if (!(off * off < square)) continue;
    const double radius = std::sqrt(square - off * off);
    scene.patches.push_back(
        {spheres.position[p] - off * normal, radius * a, radius * b, true, false, false, colour[p]});
  }
}

void add_cracks(Scene& scene, const std::vector<BrokenBond>& cracks, const std::vector<Rgb>& colour, int dimension,
                const Projection& view, double line_width) {
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    const BrokenBond& c = cracks[k];
    if (!(c.radius > 0)) continue;
    // Seen from its edge a disc has no width at all: it is a line then.
    const double width = std::min(line_width, 0.3 * c.radius);
    if (dimension == 3 && c.radius * std::abs(c.normal.dot(view.toward)) < 0.5 * width) {
      const Vec3 along = c.normal.cross(view.toward).normalized(), across = view.toward.cross(along);
      scene.patches.push_back({c.position, c.radius * along, 0.5 * width * across, false, false, false, colour[k]});
      continue;
    }
    const auto [a, b] = dimension == 2 ? std::pair<Vec3, Vec3>{Vec3(-c.normal.y(), c.normal.x(), 0), 0.18 * c.normal}
                                       : tangents(c.normal);
    scene.patches.push_back({c.position, c.radius * a, c.radius * b, dimension == 3, dimension == 3, false, colour[k]});
    if (dimension == 3)  // seen where the disc itself does not hide it
      scene.patches.push_back({c.position - 1e-3 * c.radius * view.toward, 1.08 * c.radius * a, 1.08 * c.radius * b,
                               true, false, false, rim_colour});
  }
}

void add_slabs(Scene& scene, const std::vector<Slab>& slabs) {
  for (const Slab& s : slabs)
    for (const double side : {-1.0, 1.0}) {
      scene.patches.push_back({s.centre + side * s.a, s.b, s.c, false, true, false, platen_colour});
      scene.patches.push_back({s.centre + side * s.b, s.c, s.a, false, true, false, platen_colour});
      scene.patches.push_back({s.centre + side * s.c, s.a, s.b, false, true, false, platen_colour});
    }
}

double shadow_gap(const Spheres& spheres) {
  double mean = 0;
  for (const double r : spheres.radius) mean += r / double(spheres.size());
  return 0.5 * mean;
}

namespace {

/// Of two things behind everything the first one is seen: pale discs, then darker ones that stand out at the edge
/// alone.
void add_shadow(Scene& scene, const Spheres& spheres, const Projection& view, double width) {
  const double gap = shadow_gap(spheres);
  for (const bool edge : {false, true})
    for (std::size_t p = 0; p < spheres.size(); ++p) {
      const double r = spheres.radius[p] + gap + (edge ? width : 0);
      scene.patches.push_back(
          {spheres.position[p], r * view.right, r * view.up, true, false, true, edge ? edge_colour : wall_colour});
    }
}

}  // namespace

void add_outline(Scene& scene, const SpecimenShape& s, int dimension, const Projection& view, double line_width,
                 const Spheres& spheres) {
  const Vec3 centre = s.base + 0.5 * s.height * s.axis, half = 0.5 * s.extent;
  using Outline = SpecimenShape::Outline;
  if (s.outline == Outline::irregular) return add_shadow(scene, spheres, view, line_width);
  if (dimension == 2) {
    const Vec3 a(half.x(), 0, 0), b(0, half.y(), 0);
    const bool round = s.outline != Outline::box;
    add_wall(scene, centre, a, b, round);
    if (round) return add_ellipse(scene, centre, a, b, view, line_width);
    const Vec3 corners[] = {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
    for (int k = 0; k < 4; ++k) add_line(scene, corners[k], corners[(k + 1) % 4], view, line_width);
  } else if (s.outline == Outline::cylinder) {
    add_cylinder(scene, s, view, line_width);
  } else if (s.outline == Outline::ellipsoid) {
    add_ellipsoid(scene, centre, half, view, line_width);
  } else {
    add_box(scene, centre, half, view, line_width);
  }
}

}  // namespace breccia::pictures
