// SPDX-License-Identifier: BSD-3-Clause
/// The neighbour set: which pairs, and which spheres and walls, the least-squares problem wants to touch.
#pragma once

#include <span>
#include <vector>

#include "breccia/packing_tools/container.hpp"

namespace breccia::labra_onate {

/// Centres and radii [m].
struct Spheres {
  std::vector<Vec3> x;
  std::vector<double> r;
  std::size_t size() const { return r.size(); }
};

/// Each pair appears twice, in the rows of both its spheres; rows are sorted by partner.
struct NeighbourSet {
  std::vector<std::size_t> start;  ///< size() + 1 offsets into `partner`
  std::vector<Index> partner;
  std::vector<std::uint8_t> tangent;  ///< per sphere, bit w: wants to touch wall w of `Container::walls`
  double tolerance = 0;               ///< widest relative gap, (d - s)/s with s the sum of the radii; 0: overlaps only
  std::size_t pairs() const { return partner.size() / 2; }
  std::span<const Index> row(std::size_t i) const { return {partner.data() + start[i], start[i + 1] - start[i]}; }
};

/// Finds neighbour sets of spheres that move little from one call to the next.
class NeighbourFinder {
 public:
  NeighbourFinder(const Container& box, int threads) : box_(box), threads_(threads) {}

  /// All overlapping pairs, and of the others those with the smallest relative gap until there are `pairs` in all, as
  /// long as the gap is below `widest_gap`. A wall is wanted where its gap is at most `tolerance`
  /// radii, but at least `wall_gap`. Without `pairs`, only overlaps and only walls that are touched.
  NeighbourSet find(const Spheres& s, std::size_t pairs);

  static constexpr double widest_gap = 0.4;
  static constexpr double wall_gap = 0.15;  ///< a set of overlaps alone would never draw a sphere to its wall

 private:
  void collect(const Spheres& s, double reach);
  bool still_good(const Spheres& s, double reach) const;

  const Container& box_;
  int threads_;
  Spheres then_;  // when the candidates were collected
  double reach_ = -1, skin_ = 0;
  std::vector<std::size_t> start_;
  std::vector<Index> candidate_;  // rows like those of NeighbourSet
};

}  // namespace breccia::labra_onate
