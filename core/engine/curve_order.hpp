// SPDX-License-Identifier: BSD-3-Clause
/// Particles of a packing in the order of a curve that keeps near in memory what is near in space.
#pragma once

#include <span>
#include <vector>

#include "breccia/types.hpp"
#include "engine/rank_link.hpp"

namespace breccia {

/// One particle of a packing, where the curve has it.
struct OnCurve {
  std::uint64_t place;  ///< along the curve, 63 bits
  Index id;             ///< its number in the packing: of those in one place the lower comes first
  std::uint8_t material;
  Vec3 position;
  double radius;

  /// No two have the same.
  auto key() const {
    __extension__ using Key = unsigned __int128;
    return Key(place) << 32 | id;
  }
  bool operator<(const OnCurve& other) const { return key() < other.key(); }
};

/// Sets the places of these on a Morton curve through them all and sorts them. `link`: each rank has some of the
/// particles, and gets, of all in their order, the rows from `first_row[rank]` on; null where there is but one.
void sort_along_curve(std::vector<OnCurve>& particles, RankLink* link, std::span<const Index> first_row);

}  // namespace breccia
