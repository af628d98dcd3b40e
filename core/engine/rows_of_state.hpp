// SPDX-License-Identifier: BSD-3-Clause
/// The lists of a state, one after the other. A new one gets its line here, or does not go with its particle, pair or
/// bond when a specimen is cut into parts.
#pragma once

#include <utility>
#include <vector>

#include "model/state.hpp"

namespace breccia {

/// `f(array...)` for all that have a record for each particle, of one state or of several side by side.
template <class F, class... States>
void for_each_particle_array(F&& f, States&... s) {
  f(s.particles.motion...);
  f(s.particles.load...);
  f(s.particles.reference_position...);
  f(s.particles.applied_force...);
  f(s.particles.applied_torque...);
  f(s.particles.applied_moment...);
  f(s.particles.holding_arm...);
  f(s.particles.held...);
  f(s.particles.id...);
  f(s.particles.material...);
  f(s.positions_at_rebuild...);
  f(s.positions_at_look...);
}

/// The same for each pair, but for those that are numbers of rows: i, j and bond. As many columns in each.
template <class F, class First, class... Others>
void for_each_pair_array(F&& f, First& s, Others&... o) {
  f(s.rest_length, o.rest_length...);
  f(s.state, o.state...);
  for (std::size_t c = 0; c < s.columns.size(); ++c) f(s.columns[c], o.columns[c]...);
  f(s.force, o.force...);
  f(s.moment, o.moment...);
}

/// The same for each bond, but for i, j, pair and crack.
template <class F, class... Lists>
void for_each_bond_array(F&& f, Lists&... b) {
  f(b.initial_distance...);
  f(b.state...);
  f(b.guarded...);
  f(b.released...);
}

/// All of them.
inline void swap_lists(State& s, State& t) {
  std::swap(s.particles, t.particles);
  std::swap(s.pairs, t.pairs);
  std::swap(s.bonds, t.bonds);
  s.wall_touches.swap(t.wall_touches);
  s.positions_at_rebuild.swap(t.positions_at_rebuild);
  s.positions_at_look.swap(t.positions_at_look);
}

/// The rows named stay, in their order.
template <class T>
void pick(std::vector<T>& array, const std::vector<Index>& rows) {
  if (array.empty()) return;
  std::vector<T> kept;
  kept.reserve(rows.size());
  for (const Index k : rows) kept.push_back(array[k]);
  array.swap(kept);
}

/// Where each of `size` rows stands among those named, or 0xffffffff.
inline std::vector<Index> inverse(const std::vector<Index>& rows, std::size_t size) {
  std::vector<Index> to(size, 0xffffffffu);
  for (Index k = 0; k < rows.size(); ++k) to[rows[k]] = k;
  return to;
}

}  // namespace breccia
