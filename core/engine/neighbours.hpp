// SPDX-License-Identifier: BSD-3-Clause
/// The pair list: intact bonds, contacts, and all neighbours that could touch before the list is made again.
#pragma once

#include <vector>

#include "engine/interactions.hpp"
#include "engine/rank_link.hpp"
#include "model/state.hpp"

namespace breccia {

/// The pairs in which each particle takes part: entries [start[p], start[p+1]) of `entry`, each pair * 2 + side, where
/// side is 1 when p is the pair's j. Ascending, so the sum of forces has one order whatever the thread count.
struct Incidence {
  std::vector<std::size_t> start;
  std::vector<Index> entry;
};

/// Rebuilds the pair list, of pairs with an own particle, with the given skin [m]; pairs that stay keep their history,
/// new ones get it from the law. What a pair feels does not depend on the skin: intact bonds are always listed; a pair
/// whose surfaces (and, if it was bonded once, whose initial distance) are a skin apart leaves only if it would come
/// back as it is, that is with the history that the law gives to a new pair. A bond's state and rest length are known
/// to `Bonds` and come back with the pair.
void rebuild_pairs(State& state, const Interactions& law, double skin, int threads);

Incidence make_incidence(const State& state, int threads);

/// The farthest that any particle has moved from where it was, when the cell was `cell`; against the strain of a space
/// that repeats itself [m].
double largest_displacement(const State& state, const std::vector<Vec3>& from, const Cell& cell, int threads,
                            RankLink* link);

}  // namespace breccia
