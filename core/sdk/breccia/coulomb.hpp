// SPDX-License-Identifier: BSD-3-Clause
/// A spring whose force is limited by friction: the slider of contact laws, of rolling, and of walls.
#pragma once

#include "breccia/contact.hpp"

namespace breccia {

struct CoulombSlip {
  double keep = 1;  ///< factor on the spring: 1 while it sticks
  double work = 0;  ///< dissipated by sliding in this step [J]
  bool slides = false;
};

/// `size`: length of the spring after the motion of this step, before it slides [m]; `along`: its dot product with the
/// spring before the motion [m2]; `limit`: of the force [N] (or [rad], [rad2], [N m] where the spring is a rotation).
/// The work is that of leapfrog itself, the way times the mean of the forces before and after, so that the energy of a
/// slider closes to second order in the step.
BRECCIA_KERNEL CoulombSlip coulomb_slip(double stiffness, double size, double along, double limit,
                                        bool may_slide = true) {
  const double trial = stiffness * size;
  CoulombSlip s;
  s.slides = may_slide & (trial > limit);
  // 0/0 cannot happen where it slides: trial > limit >= 0.
  s.keep = s.slides ? limit / (trial > 0 ? trial : 1.0) : 1.0;
  s.work = s.slides ? 0.5 * (stiffness * along + limit * size) * (1 - s.keep) : 0.0;
  return s;
}

}  // namespace breccia
