// SPDX-License-Identifier: BSD-3-Clause
#include "curves.hpp"

#include <Eigen/Dense>

namespace breccia::tangent_discs {

namespace {
constexpr double parallel = 1e-10;  // sine of the angle between planes or lines that count as parallel
constexpr int newton_steps = 3;     // the closed form is right to ten digits or so
}  // namespace

bool touching(const Curve& a, const Curve& b, int side, double r, Disc& out) {
  out.r = r;
  if (a.straight && b.straight) {
    const double cross = a.at.x() * b.at.y() - a.at.y() * b.at.x();
    if (side < 0 || std::abs(cross) < parallel) return false;
    const double p = a.r + r, q = b.r + r;
    out.x = Vec2(p * b.at.y() - q * a.at.y(), q * a.at.x() - p * b.at.x()) / cross;
    return true;
  }
  if (a.straight || b.straight) {
    const Curve &wall = a.straight ? a : b, &other = a.straight ? b : a;
    const double reach = other.r + r, across = wall.distance(other.at) - r;
    const double square = reach * reach - across * across;
    if (square < 0) return false;
    out.x = other.at - across * wall.at + side * std::sqrt(square) * Vec2(-wall.at.y(), wall.at.x());
    return true;
  }
  const Vec2 way = b.at - a.at;
  const double d2 = way.squaredNorm();
  if (d2 == 0) return false;
  const double reach = a.r + r, along = 0.5 * (1 + (reach * reach - (b.r + r) * (b.r + r)) / d2);  // over |way|
  const double square = reach * reach / d2 - along * along;
  if (square < 0) return false;
  out.x = a.at + along * way + side * std::sqrt(square) * Vec2(-way.y(), way.x());
  return true;
}

int side_of(const Curve& a, const Curve& b, const Vec2& x) {
  if (a.straight && b.straight) return 1;
  Vec2 way = b.at - a.at, arm = x - a.at;
  if (a.straight || b.straight) {
    const Curve &wall = a.straight ? a : b, &other = a.straight ? b : a;
    way = wall.at;
    arm = x - other.at;
  }
  return way.x() * arm.y() - way.y() * arm.x() >= 0 ? 1 : -1;
}

/// Unknowns x, y, s, seen from the centre of a curve that is not straight, radius r0: x^2 + y^2 = (r0 + s)^2. A
/// straight wall is a plane in (x, y, s); so is the difference of two such cones. The planes meet in a line p + t u,
/// which meets the cone where A t^2 + 2 B t + C = 0.
int touching(const Curve& a, const Curve& b, const Curve& c, Disc* out) {
  const Curve* curve[3] = {&a, &b, &c};
  int first = 0;
  while (first < 3 && curve[first]->straight) ++first;
  if (first == 3) return 0;  // three straight walls: their disc fills the container
  const Vec2 origin = curve[first]->at;
  const double r0 = curve[first]->r;
  Vec3 normal[2];
  double offset[2];
  for (int k = 0, n = 0; k < 3; ++k) {
    if (k == first) continue;
    const Curve& o = *curve[k];
    if (o.straight) {
      normal[n] = Vec3(o.at.x(), o.at.y(), -1);
      offset[n] = -o.distance(origin);
    } else {
      const Vec2 x = o.at - origin;
      normal[n] = 2 * Vec3(x.x(), x.y(), o.r - r0);
      offset[n] = x.squaredNorm() - (o.r - r0) * (o.r + r0);
    }
    const double length = normal[n].norm();
    if (length == 0) return 0;
    normal[n] /= length;
    offset[n++] /= length;
  }
  const Vec3 u = normal[0].cross(normal[1]);
  const double uu = u.squaredNorm();
  if (uu < parallel * parallel) return 0;
  const Vec3 p = (offset[0] * normal[1].cross(u) + offset[1] * u.cross(normal[0])) / uu;
  const double A = u.x() * u.x() + u.y() * u.y() - u.z() * u.z();
  const double B = p.x() * u.x() + p.y() * u.y() - (p.z() + r0) * u.z();
  const double C = p.x() * p.x() + p.y() * p.y() - (p.z() + r0) * (p.z() + r0);
  const double root = B * B - A * C;
  if (root < 0) return 0;
  const double q = -(B + std::copysign(std::sqrt(root), B));
  double t[2];
  int roots = 0, found = 0;
  if (A != 0) t[roots++] = q / A;
  if (q != 0) t[roots++] = C / q;
  for (int k = 0; k < roots; ++k) {
    const Disc disc{origin + Vec2(p.x() + t[k] * u.x(), p.y() + t[k] * u.y()), p.z() + t[k] * u.z()};
    bool real = disc.r > 0;  // the squares also hold for discs that round walls touch from outside
    for (const Curve* o : curve) real = real && (o->straight || o->r >= 0 || o->r + disc.r <= 0);
    if (real) out[found++] = disc;
  }
  return found;
}

void polish(std::span<const Curve> touched, Disc& disc) {
  for (int step = 0; step < newton_steps; ++step) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    Vec3 miss = Vec3::Zero();
    m(2, 2) = 1;  // the radius stays, unless a third curve says otherwise
    for (std::size_t k = 0; k < touched.size(); ++k) {
      const Curve& o = touched[k];
      Vec2 outward = o.at;
      if (!o.straight) outward = (disc.x - o.at) * ((o.r < 0 ? -1 : 1) / std::sqrt((disc.x - o.at).squaredNorm()));
      m.row(Eigen::Index(k)) << outward.x(), outward.y(), -1;
      miss[Eigen::Index(k)] = o.distance(disc.x) - disc.r;
    }
    if (std::abs(m.determinant()) < parallel) return;
    const Vec3 change = m.inverse() * miss;
    disc.x -= change.head<2>();
    disc.r -= change.z();
  }
}

}  // namespace breccia::tangent_discs
