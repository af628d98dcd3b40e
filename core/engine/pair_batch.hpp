// SPDX-License-Identifier: BSD-3-Clause
/// Where the pairs of a list, and what the laws do with them, stand in memory.
#pragma once

#include "breccia/chunk.hpp"
#include "breccia/views.hpp"
#include "model/state.hpp"

namespace breccia {

/// What a pair adds to its particles, for those that are summed apart.
struct CutForce {
  double fx, fy, fz;  ///< force on i; minus this on j [N]
  double tx, ty, tz;  ///< n x shear force: the torque on i, and on j, per unit of their lever arms [N]
  double half_gap;    ///< (distance - r_i - r_j)/2 [m]
  double mx, my, mz;  ///< moment on i; minus this on j [N m]
};

/// What a law booked as fracture of one pair.
struct Released {
  Index pair;
  double energy;  // [J]
};

/// Pairs [begin, end) of the state's arrays.
struct PairBatch {
  static constexpr std::size_t chunk = PairChunk::capacity;
  std::size_t begin = 0, end = 0;
  /// Where each chunk begins, see `Chunks`, and the number of the one that `begin` is of; null: every 64 pairs from 0.
  const std::size_t* chunk_start = nullptr;
  std::size_t first_chunk = 0;
  const Index *i = nullptr, *j = nullptr;
  const double* rest_length = nullptr;
  BondState* state = nullptr;
  const std::uint8_t* guarded = nullptr;  ///< 1 for pairs whose bond must not break; null when there are none
  double* const* columns = nullptr;       ///< the laws' history, one array each
  const ParticleMotion* motion = nullptr;
  const std::uint8_t* material = nullptr;  ///< of the particles; null where there is but one
  std::size_t materials = 1;
  const Index* id = nullptr;  ///< of the particles, in the packing
  PairForce* force = nullptr;
  Vec3* moment = nullptr;
  bool keep_force = true;  ///< write `force` and `moment`
  /// Sums per particle, added to in the order of the pairs; none if null. Particles in `apart` are left out: they have
  /// pairs in other batches. `chunk_cut` says where in `cut` those of a chunk with pairs of such particles go, or
  /// `whole`.
  ParticleLoad* sum = nullptr;
  static constexpr Index whole = 0xffffffffu;
  const std::uint8_t* apart = nullptr;
  const Index* chunk_cut = nullptr;
  CutForce* cut = nullptr;
  Dissipated* dissipated = nullptr;           ///< added to: one per chunk and law, those of a chunk side by side
  std::uint8_t* chunk_broke = nullptr;        ///< one per chunk, set when a bond in it broke
  std::vector<Released>* released = nullptr;  ///< appended to; not kept if null
  double time_step = 0;
  const Cell* cell = nullptr;  ///< of a space that repeats itself; null where it does not
  const Mat3* cell_velocity = nullptr;
  CellForces* cell_forces = nullptr;  ///< one per chunk, written anew; none if null
};

/// All pairs of the state. `column_pointers` keeps what `columns` points to.
PairBatch whole_batch(State& state, std::vector<double*>& column_pointers);

}  // namespace breccia
