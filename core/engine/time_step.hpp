// SPDX-License-Identifier: BSD-3-Clause
/// The largest stable time step.
#pragma once

#include <optional>

#include "engine/neighbours.hpp"
#include "model/state.hpp"

namespace breccia {

/// A bound from each particle's own 6x6 stiffness K and damping C with its neighbours held (intact bonds, and pairs and
/// wall touches `within reach`, counted as active) [s]: the least dt, over the particles, at which
///
///   lambda_max(M^-1 (dt^2/2 K + dt C)) = 1;  without dashpots dt = 2/sqrt(2 lambda_max(M^-1 K)).
///
/// Why: a dashpot is evaluated with the velocity of the last half step, v- = (v- + v+)/2 - (v+ - v-)/2. The second part
/// makes it leapfrog with the mass M - dt C/2, the first takes energy; the energy that undamped leapfrog conserves is
/// then positive, and bounds the motion, while dt^2 K/4 + dt C/2 < M. A spring's energy, and a dashpot's power, are at
/// most twice those of its two ends moving alone: 2 K and 2 C of single particles bound those of the whole system.
///
/// Looks at the given particles only; 0 when a stiffness is no finite number, infinite when none of them is held by
/// anything stiff.
double critical_time_step(State& state, const Interactions& law, const Incidence& incidence,
                          const std::vector<Index>& particles, double reach, int threads);

/// The same of each particle by itself [s].
std::vector<double> time_step_of_each(State& state, const Interactions& law, const Incidence& incidence, double reach,
                                      int threads);

/// The one particle, or the few, that make the time step of all others much shorter.
struct StepSetter {
  Index particle;                ///< the one with the least bound; its row in the whole specimen
  std::size_t others;            ///< whose bounds are far below those of the rest, too
  double step;                   ///< critical, of all [s]
  double without;                ///< critical, of all but these [s]
  Index id = 0;                  ///< of that one: its number in the packing
  double radius = 0;             // [m]
  Vec3 position = Vec3::Zero();  // [m]
};

/// Those whose bound is more than `ratio` times below all that is left: at most 1 % of the particles (one in less than
/// 200), of ten at the least. `critical` is that of all. Nothing when the bulk sets the step.
std::optional<StepSetter> find_step_setter(State& state, const Interactions& law, const Incidence& incidence,
                                           double reach, double critical, double ratio, int threads,
                                           RankLink* link = nullptr);

/// The own particles that have come within `reach` [m] of a neighbour or a wall since `positions_at_look`, ascending:
/// they may ask for a shorter time step. All that have any when nobody has looked yet. Walls move: those that touch one
/// count each time, but for the touches that are `known` (sorted by wall and particle).
std::vector<Index> newly_within_reach(const State& state, double reach, const std::vector<WallTouch>* known = nullptr);

}  // namespace breccia
