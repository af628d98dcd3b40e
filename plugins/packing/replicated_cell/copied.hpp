// SPDX-License-Identifier: BSD-3-Clause
/// The copies of a cell, or a share of them, and what is measured of all of them.
#pragma once

#include "placing.hpp"

namespace breccia::replicated_cell {

struct CellMeasures {
  double particles = 0;
  double solid = 0;                              ///< their own volumes, areas in two dimensions [m3], [m2]
  double contacts = 0;                           ///< a particle
  double max_overlap = 0;                        ///< over the sum of the radii
  double radius_mean = 0, radius_deviation = 0;  ///< [m]
  double radius_min = 0, radius_max = 0;         ///< [m]
};

/// Particles are counted through all copies, those of the first first. A contact of the cell is one of each copy with
/// itself or with the copy that many cells farther, where that is there: nothing is searched for in the whole.
class Copied {
 public:
  /// `of_cell`: the space in which the cell repeats itself. All that is given outlives this.
  Copied(const PackedParticles& cell, const Space& of_cell, const Placing& place, const PackingRequest& request);

  PackedParticles particles(const Host& host) const;  ///< those of the share that is asked for; centres, radii, columns
  CellMeasures measure(const Host& host) const;       ///< of all shares together
  CellMeasures cell_alone() const;                    ///< as it repeats itself

 private:
  struct Contact {
    Index with;
    std::array<long, 3> cells;  ///< so many farther
    double overlap;
  };
  /// Calls f(k, copy) for each particle of the cell that is to be a particle of this share.
  template <class F>
  void for_each(const Host& host, F&& f) const;
  bool holds(std::size_t k, const std::array<long, 3>& copy) const;
  bool is_there(const Contact& contact, std::array<long, 3> copy) const;

  const PackedParticles& cell_;
  const Space& of_cell_;
  const Placing& place_;
  const PackingRequest& request_;
  Vec3 period_;
  std::vector<std::vector<Contact>> contacts_;  ///< of each particle of the cell
};

}  // namespace breccia::replicated_cell
