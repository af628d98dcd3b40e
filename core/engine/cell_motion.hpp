// SPDX-License-Identifier: BSD-3-Clause
/// A space that repeats itself and is strained: how its cell moves, what that does to the particles and to the ledger.
///
/// Particles have the velocities that one sees from outside, and are never moved from one face of the cell to the
/// other: an image of theirs moves as they do plus what the cell's vectors grow. While these grow steadily nothing else
/// is needed: an even lattice stays even. When their growth changes all particles are pushed by the change that goes
/// with their place, as if the whole space had been taken along.
#pragma once

#include "engine/rank_link.hpp"
#include "model/state.hpp"

namespace breccia {

/// How fast a strained space moves at a place, seen from its centre of mass: so momentum is kept.
struct CellMotion {
  Mat3 before = Mat3::Zero(), after = Mat3::Zero();  ///< gradient of velocity in the half steps behind and ahead [1/s]
  Vec3 centre = Vec3::Zero();                        // [m]
  bool any() const { return !before.isZero(0) || !after.isZero(0); }
};

/// From the growth of the half step behind to that which was asked for; books the work of the cell in both. What the
/// particles feel of it is for `integrate`.
CellMotion lead_cell(State& state, RankLink* link);

/// By one step, as the particles.
void move_cell(State& state);

/// Work of the cell's growth in the half step behind the positions [J].
double cell_work_behind(const State& state);

/// UserError if a particle could meet two images of another within `length` [m].
void refuse_narrow_cell(const Space& space, double length);

}  // namespace breccia
