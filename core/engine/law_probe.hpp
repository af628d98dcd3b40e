// SPDX-License-Identifier: BSD-3-Clause
/// Asks the contact laws about single pairs, so that what is wrong with its answers is laid at its door.
#pragma once

#include <optional>

#include "engine/interactions.hpp"
#include "model/state.hpp"

namespace breccia {

/// What the law says of a pair at rest whose distance is changed by a little; the state is left alone.
struct LawAnswer {
  double normal = 0;   ///< force, tension positive [N]
  double energy = 0;   ///< [J]
  bool finite = true;  ///< force, moment and history are all finite numbers
};
LawAnswer ask_law(State& state, const Interactions& laws, std::size_t pair, double stretch);
ContactStiffness ask_stiffness(State& state, const Interactions& laws, std::size_t pair);

/// "particles 3 and 17", as numbered in the packing.
std::string pair_name(const State& state, std::size_t pair);

/// UserError, before the first step, when the law states a stiffness that is not a finite number or less than half of
/// what its force shows: the time step would be too long. Looks at up to 64 pairs that hold or touch.
void check_stiffness(State& state, const Interactions& laws);

/// What a law is to blame for when a velocity is no longer a finite number: the first pair, at a sound distance, whose
/// force is none. Empty when there is no such pair.
std::optional<std::string> blame_force(State& state, const Interactions& laws);

/// The same for the stored energy and for the stiffness.
std::optional<std::string> blame_energy(State& state, const Interactions& laws);
std::optional<std::string> blame_stiffness(State& state, const Interactions& laws);

}  // namespace breccia
