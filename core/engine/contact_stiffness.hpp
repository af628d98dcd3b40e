// SPDX-License-Identifier: BSD-3-Clause
/// Linearised stiffness of contacts as particles with six degrees of freedom feel it; what the time step is made of.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "breccia/contact_law.hpp"
#include "model/state.hpp"

namespace breccia {

using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< displacement, rotation
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// A contact seen from one of its ends: the unit normal points to the other end.
struct ContactEnd {
  Vec3 normal;
  double own_arm, other_arm;  ///< from the centres to the contact point [m]
  ContactStiffness stiffness;
};

/// Stiffness of this end with the other one held, added to `k`.
void add_contact(Mat6& k, const ContactEnd& end);

/// What this end's spring resists with when the ends move by `own` and `other`, K u [N, N m], added to `load`: with
/// `other` zero the product of the matrix above and `own`.
inline void add_resistance(double* load, const ContactEnd& e, const double* own, const double* other) {
  const double nx = e.normal[0], ny = e.normal[1], nz = e.normal[2];
  const double px = e.own_arm * own[3] + e.other_arm * other[3], py = e.own_arm * own[4] + e.other_arm * other[4],
               pz = e.own_arm * own[5] + e.other_arm * other[5];
  const double dx = other[0] - own[0], dy = other[1] - own[1], dz = other[2] - own[2];
  const double along = dx * nx + dy * ny + dz * nz, kn = e.stiffness.normal * along, ks = e.stiffness.shear;
  const double fx = ks * (dx - along * nx - (py * nz - pz * ny)), fy = ks * (dy - along * ny - (pz * nx - px * nz)),
               fz = ks * (dz - along * nz - (px * ny - py * nx));
  load[0] -= kn * nx + fx;
  load[1] -= kn * ny + fy;
  load[2] -= kn * nz + fz;
  load[3] -= e.own_arm * (ny * fz - nz * fy);
  load[4] -= e.own_arm * (nz * fx - nx * fz);
  load[5] -= e.own_arm * (nx * fy - ny * fx);
}

/// The same of its moments [N m].
inline void add_moment_resistance(double* load, const ContactEnd& e, const double* own, const double* other) {
  const double nx = e.normal[0], ny = e.normal[1], nz = e.normal[2];
  const double wx = other[3] - own[3], wy = other[4] - own[4], wz = other[5] - own[5];
  const double twist = (e.stiffness.torsion - e.stiffness.bending) * (wx * nx + wy * ny + wz * nz);
  load[3] -= e.stiffness.bending * wx + twist * nx;
  load[4] -= e.stiffness.bending * wy + twist * ny;
  load[5] -= e.stiffness.bending * wz + twist * nz;
}

/// Its dashpot as if it were a spring.
inline ContactEnd dashpot_of(const ContactEnd& e) {
  return {e.normal, e.own_arm, e.other_arm, {e.stiffness.damping, e.stiffness.shear_damping}};
}

/// The same of its dashpot, C v [N, N m] for velocities.
inline void add_damping_resistance(double* load, const ContactEnd& e, const double* own, const double* other) {
  add_resistance(load, dashpot_of(e), own, other);
}

/// The dt at which dt^2/2 k + dt c = 1; infinite when nothing holds.
inline double step_of(double k, double c) {
  const double root = c + std::sqrt(c * c + 2 * k);
  return root > 0 ? 2 / root : std::numeric_limits<double>::infinity();
}

/// Whether a pair of the list could exert a force before its ends have moved by `reach` in all, from where they are in
/// `position`. A pair that was bonded once feels its partner from the bond's length on.
bool within_reach(const State& state, std::size_t pair, Strided<const Vec3> position, double reach);
bool within_reach(const State& state, const WallTouch& touch, double reach);

/// The pair as its `i` (or, `second`, its `j`) sees it; the centres do not coincide.
ContactEnd end_of(const State& state, std::size_t pair, bool second, const ContactStiffness& stiffness);
/// A wall as a particle near it sees it: nothing at the other end moves.
ContactEnd end_of(const State& state, const WallTouch& touch);

}  // namespace breccia
