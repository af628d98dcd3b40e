// SPDX-License-Identifier: BSD-3-Clause
/// Finds the particles whose surfaces are nearer than a skin.
#pragma once

#include <span>
#include <vector>

#include "breccia/images.hpp"
#include "model/state.hpp"

namespace breccia {

/// Keeps copies of what it reads in the order of the cells, so that candidates lie side by side in memory.
class NeighbourSearch {
 public:
  /// UserError if space repeats itself so soon that a particle could meet two images of another. Both are kept by
  /// reference.
  NeighbourSearch(const Space& space, const Particles& particles, double skin);
  NeighbourSearch(Space&&, const Particles&, double) = delete;

  /// Appends, in no particular order, every j > i whose branch vector is shorter than r_i + r_j + skin. Any number of
  /// threads may ask.
  void append_partners(Index i, std::vector<Index>& out) const;

 private:
  /// With strays moved to the edge of a box around the others: those that are near each other stay so, and the grid is
  /// as fine as without them. Empty when the grid can do with all as they are.
  static std::vector<Vec3> drawn_in(std::span<const Vec3> points, double reach);

  const Space& space_;
  const Particles& p_;
  double skin_, reach_;
  Images images_;
  std::vector<Vec3> drawn_in_;  ///< places in the grid, if other than the particles' own
  CellGrid grid_;
  std::vector<double> x_, y_, z_, r_;
};

}  // namespace breccia
