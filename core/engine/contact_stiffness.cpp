// SPDX-License-Identifier: BSD-3-Clause
#include "engine/contact_stiffness.hpp"

#include <algorithm>

#include "engine/walls.hpp"

namespace breccia {

void add_contact(Mat6& k, const ContactEnd& e) {
  const Vec3& n = e.normal;
  const double arm = e.own_arm;
  const ContactStiffness& c = e.stiffness;
  const Mat3 nn = n * n.transpose(), tangent = Mat3::Identity() - nn;
  Mat3 cross;  // cross * v = n x v
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  // The contact point moves by u + w x (arm n) = u - arm (n x w).
  k.topLeftCorner<3, 3>() += c.normal * nn + c.shear * tangent;
  k.topRightCorner<3, 3>() += -c.shear * arm * cross;
  k.bottomLeftCorner<3, 3>() += c.shear * arm * cross;
  k.bottomRightCorner<3, 3>() += (c.shear * arm * arm + c.bending) * tangent + c.torsion * nn;
}

bool within_reach(const State& s, std::size_t pair, Strided<const Vec3> position, double reach) {
  if (s.pairs.state[pair] == BondState::intact) return true;
  const Index i = s.pairs.i[pair], j = s.pairs.j[pair];
  const double length = std::max(s.particles.radius()[i] + s.particles.radius()[j], s.pairs.rest_length[pair]);
  return s.branch(position[i], position[j]).norm() < length + reach;
}

bool within_reach(const State& s, const WallTouch& t, double reach) {
  return facing(s.walls[t.wall], s.particles.position()[t.particle]).distance - s.particles.radius()[t.particle] <=
         reach;
}

ContactEnd end_of(const State& s, std::size_t pair, bool second, const ContactStiffness& stiffness) {
  const Particles& p = s.particles;
  const Index i = s.pairs.i[pair], j = s.pairs.j[pair];
  const Vec3 branch = s.branch(p.position()[i], p.position()[j]);
  const double d = branch.norm(), half_gap = 0.5 * (d - p.radius()[i] - p.radius()[j]);
  return {branch / (second ? -d : d), p.radius()[second ? j : i] + half_gap, p.radius()[second ? i : j] + half_gap,
          stiffness};
}

ContactEnd end_of(const State& s, const WallTouch& t) {
  const Wall& w = s.walls[t.wall];
  return {-facing(w, s.particles.position()[t.particle]).normal,
          s.particles.radius()[t.particle],
          0,
          {w.normal_stiffness, w.friction > 0 ? w.shear_stiffness : 0, 0, 0}};
}

}  // namespace breccia
