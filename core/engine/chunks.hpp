// SPDX-License-Identifier: BSD-3-Clause
/// How the pairs are dealt to chunks. What is summed over pairs is summed chunk by chunk and block by block, so this
/// decides the bits of every such sum.
#pragma once

#include "model/state.hpp"

namespace breccia {

/// Grain of the sums over particles, and of what may be dealt to threads or machines: a cut between blocks changes no
/// sum.
inline constexpr std::size_t particle_block = 256;

/// A pair belongs to its lower particle. The chunks of a block of particles are its own: they begin anew with each
/// block, whatever stands before it.
struct Chunks {
  std::vector<std::size_t> start{0};        ///< first pair of each; at the end the number of pairs
  std::vector<std::size_t> block_start{0};  ///< first chunk of each block of particles; at the end that of chunks
  std::size_t size() const { return start.size() - 1; }
  std::size_t blocks() const { return block_start.size() - 1; }
};

Chunks make_chunks(const State& state);

}  // namespace breccia
