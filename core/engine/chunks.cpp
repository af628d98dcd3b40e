// SPDX-License-Identifier: BSD-3-Clause
#include "engine/chunks.hpp"

#include <algorithm>

#include "engine/pair_batch.hpp"

namespace breccia {

Chunks make_chunks(const State& s) {
  const auto& first = s.pairs.i;
  Chunks c{{}, {}};
  const auto row = [&](std::size_t particle) {
    return std::size_t(std::lower_bound(first.begin(), first.end(), Index(particle)) - first.begin());
  };
  const std::size_t own = s.particles.first_own(), end_own = s.particles.end_own();
  for (std::size_t k = 0; k < row(own); k += PairBatch::chunk) c.start.push_back(k);
  for (std::size_t p = own; p < end_own; p += particle_block) {
    c.block_start.push_back(c.start.size());
    const std::size_t end = row(std::min(end_own, p + particle_block));
    for (std::size_t k = row(p); k < end; k += PairBatch::chunk) c.start.push_back(k);
  }
  c.block_start.push_back(c.start.size());
  c.start.push_back(first.size());
  return c;
}

}  // namespace breccia
