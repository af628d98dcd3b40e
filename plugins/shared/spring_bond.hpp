// SPDX-License-Identifier: BSD-3-Clause
/// What bonds of four linear springs that break at once have in common: along the line of centres, across it, in
/// bending and in twisting. A law adds its stiffnesses and when it breaks.
#pragma once

#include "bond_turning.hpp"

namespace breccia {

/// The State of such a law.
struct SpringBond {
  double shear_x, shear_y, shear_z, bending_x, bending_y, bending_z, twist;
};
inline constexpr std::array spring_bond_columns{
    StateColumn<SpringBond>{&SpringBond::shear_x, "bond_shear_x", "m"},
    StateColumn<SpringBond>{&SpringBond::shear_y, "bond_shear_y", "m"},
    StateColumn<SpringBond>{&SpringBond::shear_z, "bond_shear_z", "m"},
    StateColumn<SpringBond>{&SpringBond::bending_x, "bond_bending_x", "rad"},
    StateColumn<SpringBond>{&SpringBond::bending_y, "bond_bending_y", "rad"},
    StateColumn<SpringBond>{&SpringBond::bending_z, "bond_bending_z", "rad"},
    StateColumn<SpringBond>{&SpringBond::twist, "bond_twist", "rad"}};

/// How far the springs are drawn by the end of this step, and were by the end of the one before in the present plane.
struct SpringMotion {
  double opened, opened_before;       // [m]
  PlaneVector across, across_before;  // [m]
  BondTurning turning;
};

/// `across`: tangential motion of this step at the point where the springs are fixed [m].
BRECCIA_KERNEL SpringMotion spring_motion(const Contact& c, const SpringBond& s, const PlaneVector& across) {
  SpringMotion m;
  m.opened = c.distance - c.rest_length;
  m.opened_before = m.opened - c.normal_velocity * c.time_step;
  m.across_before = follow_plane(c, s.shear_x, s.shear_y, s.shear_z);
  m.across = {m.across_before.x + across.x, m.across_before.y + across.y, m.across_before.z + across.z};
  m.turning = bond_turning(c, s);
  return m;
}

/// Force and moment while the bond holds (`hold` 1, else 0), and what it keeps of the motion.
BRECCIA_KERNEL ContactForce spring_force(const Contact& c, const ContactStiffness& k, const SpringMotion& m,
                                         double hold, SpringBond& s) {
  s.shear_x = hold * m.across.x;
  s.shear_y = hold * m.across.y;
  s.shear_z = hold * m.across.z;
  s.bending_x = hold * m.turning.now.x;
  s.bending_y = hold * m.turning.now.y;
  s.bending_z = hold * m.turning.now.z;
  s.twist = hold * m.turning.twist;
  const double twisting = k.torsion * s.twist;
  ContactForce f;
  f.normal = hold * k.normal * m.opened;
  f.shear_x = k.shear * s.shear_x;
  f.shear_y = k.shear * s.shear_y;
  f.shear_z = k.shear * s.shear_z;
  f.moment_x = k.bending * s.bending_x + twisting * c.nx;
  f.moment_y = k.bending * s.bending_y + twisting * c.ny;
  f.moment_z = k.bending * s.bending_z + twisting * c.nz;
  return f;
}

/// Of a bond that breaks in this step: what it stored, less the work that its force and moment did not do in the step
/// any more, as leapfrog has it: half of them times the way. A spring loses half its force times where it was before
/// the step [J].
BRECCIA_KERNEL double spring_loss(const ContactStiffness& k, const SpringMotion& m) {
  const PlaneVector &x = m.across, &was = m.across_before, &b = m.turning.now, &bent = m.turning.before;
  return 0.5 * (k.normal * m.opened * m.opened_before + k.shear * (was.x * x.x + was.y * x.y + was.z * x.z) +
                k.bending * (bent.x * b.x + bent.y * b.y + bent.z * b.z) +
                k.torsion * m.turning.twist_before * m.turning.twist);
}

/// Stored [J].
BRECCIA_KERNEL double spring_energy(const Contact& c, const ContactStiffness& k, const SpringBond& s) {
  const double opened = c.intact > 0.5 ? c.distance - c.rest_length : 0.0;
  const double shear2 = s.shear_x * s.shear_x + s.shear_y * s.shear_y + s.shear_z * s.shear_z;
  const double bending2 = s.bending_x * s.bending_x + s.bending_y * s.bending_y + s.bending_z * s.bending_z;
  return 0.5 * (k.normal * opened * opened + k.shear * shear2 + k.bending * bending2 + k.torsion * s.twist * s.twist);
}

}  // namespace breccia
