// SPDX-License-Identifier: BSD-3-Clause
/// Which thread looks after which pairs and particles.
#pragma once

#include "engine/chunks.hpp"
#include "engine/neighbours.hpp"
#include "engine/pair_batch.hpp"
#include "model/state.hpp"

namespace breccia {

/// What one thread does: whole chunks of pairs, and the particles whose rows begin there.
struct Share {
  std::size_t first_pair = 0, end_pair = 0, first_chunk = 0;
  Index first_particle = 0, end_particle = 0;
  std::vector<Index> apart;  ///< those of the particles that have pairs of other shares too
  std::vector<Index> cut;    ///< where in `Partition::cut` their pairs stand, in the order of their rows of `Incidence`
};

/// A particle with all its pairs in one share is summed by that thread while the pair forces are in its registers and
/// caches; a particle set apart, from what is kept of its pairs, when all threads are through. Both add in the order of
/// the pairs, so that who is apart, which depends on the number of threads, does not show.
struct Partition {
  std::vector<Share> shares;
  std::vector<std::uint8_t> apart;  ///< per particle
  std::vector<Index> chunk_cut;     ///< per chunk of pairs: see `PairBatch`
  std::vector<CutForce> cut;        ///< of the chunks that have a pair of one, chunk by chunk
};

Partition make_partition(const State& state, const Incidence& incidence, const Chunks& chunks, int threads);

}  // namespace breccia
