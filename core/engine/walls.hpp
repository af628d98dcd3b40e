// SPDX-License-Identifier: BSD-3-Clause
/// Rigid walls, planes and cylinders: a linear penalty spring, and a Coulomb-limited tangential spring when the wall
/// has friction.
#pragma once

#include "engine/exact_sum.hpp"
#include "engine/external_loads.hpp"
#include "model/state.hpp"

namespace breccia {

/// A wall as a particle sees it.
struct Facing {
  double distance;  ///< of the particle's centre from the wall's surface [m]
  Vec3 normal;      ///< from the surface to the particle
};
Facing facing(const Wall& wall, const Vec3& position);

/// Own particles within `reach` [m] of a wall; touches that stay keep their friction spring.
void rebuild_wall_touches(State& state, double reach);

/// Forces of the walls on particles. `sums`, as many as `wall_sums`: the particles' forces on each wall, and what
/// friction took [J], are added to them.
void wall_forces(State& state, ExternalLoads& loads, std::span<ExactSum> sums);
std::size_t wall_sums(const State& state);
/// With the totals of these: the particles' force on each wall. Adds this step's work of the walls and their friction
/// to the ledger.
void take_wall_forces(State& state, std::span<const double> totals);

/// Work of the walls in the half of the present step that lies ahead of the positions; `wall_forces` has counted it
/// [J].
double wall_work_ahead(const State& state);

void move_walls(State& state);

void add_wall_energy(const State& state, ExactSum& to);  ///< stored in penalty and friction springs [J]

}  // namespace breccia
