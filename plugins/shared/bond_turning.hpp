// SPDX-License-Identifier: BSD-3-Clause
/// Bending and twist of a bond, summed step by step and carried along with the pair.
#pragma once

#include "breccia/contact_law.hpp"

namespace breccia {

struct BondTurning {
  PlaneVector before, now;     ///< bending by the end of the step before, in the present plane; and now [rad]
  double twist_before, twist;  // [rad]
};

/// Of a law's State with members bending_x, bending_y, bending_z and twist.
template <class State>
BRECCIA_KERNEL BondTurning bond_turning(const Contact& c, const State& s) {
  BondTurning t;
  t.before = follow_plane(c, s.bending_x, s.bending_y, s.bending_z);
  const double turned = c.turn_x * c.nx + c.turn_y * c.ny + c.turn_z * c.nz;
  t.now = {t.before.x + (c.turn_x - turned * c.nx), t.before.y + (c.turn_y - turned * c.ny),
           t.before.z + (c.turn_z - turned * c.nz)};
  t.twist = s.twist + turned;
  t.twist_before = t.twist - turned;
  return t;
}

}  // namespace breccia
