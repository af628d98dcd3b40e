// SPDX-License-Identifier: BSD-3-Clause
/// The way of pairs between memory and the chunks that laws see: what belongs to their particles is gathered, their
/// answers are added to the sums of the particles. Four pairs at a time, as vectors.
#pragma once

#include "engine/pair_batch.hpp"

namespace breccia {

/// By how many cells each j is taken back to be the image nearest to i.
struct alignas(64) PairImages {
  double x[PairChunk::capacity], y[PairChunk::capacity], z[PairChunk::capacity];
};

/// Asks for the second particles of pairs [first, end), which come from anywhere, while the chunk before them is worked
/// on. The first ones, and all that belongs to pairs, come in order: asked for as well, they are in the way.
void fetch_ahead(const PairBatch& batch, std::size_t first, std::size_t end);

/// Pairs [first, first + n), at most a chunk of them; masses only where asked for. In a space that repeats itself each
/// j is the image nearest to its i, and `images` says which.
void gather_chunk(const PairBatch& batch, std::size_t first, std::size_t n, bool with_mass, PairChunk& chunk,
                  PairImages& images);

/// Forces of the chunk numbered `at`, of the pairs from `first` on, to memory where they are wanted, and to the sums of
/// their particles.
void scatter_chunk(const PairBatch& batch, std::size_t at, std::size_t first, bool moments, const PairChunk& chunk,
                   const PairAnswer& answer);

}  // namespace breccia
