// SPDX-License-Identifier: BSD-3-Clause
/// How the contact point of j has moved against that of i in this step, whole and in space. A law is told that motion
/// in parts, along the line of centres and across it; a joint takes it apart another way.
#pragma once

#include "breccia/contact_law.hpp"

namespace breccia::jcfpm {

/// [m], in the frame of the middle of the step, where the velocities belong: second order, as the parts are. The part
/// across comes carried to the present plane and with half the spin, which is undone here.
BRECCIA_KERNEL PlaneVector motion_of_contact(const Contact& c) {
  const double half = 0.5 * c.spin;
  const double ux = c.shear_x - half * (c.ny * c.shear_z - c.nz * c.shear_y),
               uy = c.shear_y - half * (c.nz * c.shear_x - c.nx * c.shear_z),
               uz = c.shear_z - half * (c.nx * c.shear_y - c.ny * c.shear_x);
  // One less the cosine of half the step's turn, from the difference: of the cosine nothing but rounding would be left.
  const double dx = c.nx - c.mid_x, dy = c.ny - c.mid_y, dz = c.nz - c.mid_z;
  const double turned = 0.5 * (dx * dx + dy * dy + dz * dz), unit = 1 - turned;
  const double lift = (ux * c.mid_x + uy * c.mid_y + uz * c.mid_z) / unit;
  // The distance grows faster at the end of a step than in its middle by what the line of centres has turned.
  const double along = unit * (c.normal_velocity * c.time_step - 4 * turned * c.distance);
  return {ux - lift * c.nx + along * c.mid_x, uy - lift * c.ny + along * c.mid_y, uz - lift * c.nz + along * c.mid_z};
}

}  // namespace breccia::jcfpm
