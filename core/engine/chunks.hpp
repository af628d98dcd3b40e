// SPDX-License-Identifier: BSD-3-Clause
/// How the pairs are dealt to chunks. What is summed over pairs is summed chunk by chunk and block by block, so this
/// decides the bits of every such sum.
#pragma once

#include <algorithm>

#include "engine/exact_sum.hpp"
#include "model/state.hpp"

namespace breccia {

/// A pair belongs to its lower particle. The chunks of a block of particles are its own: they begin anew with each
/// block, whatever stands before it.
struct Chunks {
  std::vector<std::size_t> start{0};  ///< first pair of each; at the end the number of pairs
  /// First chunk of each block of own particles; at the end that of chunks. Those before the first, of a part of a
  /// specimen, are of pairs that are counted elsewhere.
  std::vector<std::size_t> block_start{0};
  std::size_t first_counted() const { return block_start.front(); }
  std::size_t size() const { return start.size() - 1; }
  std::size_t blocks() const { return block_start.size() - 1; }
};

Chunks make_chunks(const State& state);

/// Of own particles.
inline std::size_t blocks_of(const Particles& p) {
  return (p.end_own() - p.first_own() + particle_block - 1) / particle_block;
}

/// Sums `of(particle)` over each block of own particles, and these sums exactly: the same bits wherever cuts between
/// blocks are.
template <class F>
void add_block_by_block(const Particles& p, ExactSum& to, F&& of) {
  for (std::size_t first = p.first_own(); first < p.end_own(); first += particle_block) {
    double sum = 0;
    for (std::size_t a = first; a < std::min(p.end_own(), first + particle_block); ++a) sum += of(a);
    to.add(sum);
  }
}

}  // namespace breccia
