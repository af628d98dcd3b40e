// SPDX-License-Identifier: BSD-3-Clause
/// Sums the pair forces on each particle, adds damping and moves it.
#pragma once

#include <span>

#include "engine/cell_motion.hpp"
#include "engine/exact_sum.hpp"
#include "engine/external_loads.hpp"
#include "engine/partition.hpp"
#include "model/state.hpp"

namespace breccia {

/// Non-viscous damping coefficients alpha: a force -alpha |F| v/|v| on the norm of the undamped resultant
/// (Rojek et al. 2012, Eqs. 5-6), and the same for torque and angular velocity.
struct Damping {
  double translational = 0, rotational = 0;
};

/// What a block of particles has taken and got since the ledger was looked at [J].
struct BlockAccount {
  double damping = 0, boundary_work = 0;
};

/// Before the pairs of a share are evaluated: `force` and `torque` of its particles are zero.
void clear_forces(State& state, const Share& share);

/// After all pairs are: sums the particles set apart that this share was dealt, and adds walls' and applied loads to
/// those and to its own. Copies of other parts' particles are left as they are: nobody reads their sums.
void complete_forces(State& state, const Share& share, const Partition& partition, const Incidence& incidence,
                     const ExternalLoads& loads);

/// Leapfrog: velocities by one step with the resultants in `force` and `torque` and damping, then positions.
/// Held components keep their velocity; the work that this takes counts as boundary work. Particles whose velocity is
/// no finite number, and those next to them in memory, are not moved. In a space that is strained, what is damped and
/// what counts as speed is the motion against it. Of own particles; `accounts`: of their blocks, added to. Returns the
/// largest speed, infinite if one, or a spin, is not a finite number [m/s].
double integrate(State& state, const Damping& damping, const CellMotion& cell, bool any_applied, int threads,
                 std::span<BlockAccount> accounts);

/// After a step that left a velocity that is no finite number: the positions of before it.
void undo_positions(State& state);

/// Work of the hands that lead held particles, in the half step that lies behind the positions: `integrate` books whole
/// steps ahead, with the resultant at their beginning [J].
void add_led_work_behind(const State& state, ExactSum& to);

/// At the time of the positions [J], as 1/2 m v(before) v(after) with the velocities half a step to either side: the
/// form that leapfrog conserves exactly, together with the stored energy, in a linear system. Damping is left out of
/// the second on purpose, since the ledger counts its work up to the middle of the step only.
void add_kinetic_energy(const State& state, ExactSum& to);

}  // namespace breccia
