// SPDX-License-Identifier: BSD-3-Clause
/// Finds the particles whose surfaces are nearer than a skin.
#pragma once

#include <vector>

#include "breccia/images.hpp"
#include "model/state.hpp"

namespace breccia {

/// Keeps copies of what it reads in the order of the cells, so that candidates lie side by side in memory.
class NeighbourSearch {
 public:
  /// UserError if space repeats itself so soon that a particle could meet two images of another.
  NeighbourSearch(const Space& space, const Particles& particles, double skin);

  /// Appends, in no particular order, every j > i whose branch vector is shorter than r_i + r_j + skin. Any number of
  /// threads may ask.
  void append_partners(Index i, std::vector<Index>& out) const;

 private:
  const Space& space_;
  const Particles& p_;
  double skin_, reach_;
  Images images_;
  CellGrid grid_;
  std::vector<double> x_, y_, z_, r_;
};

}  // namespace breccia
