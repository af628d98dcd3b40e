// SPDX-License-Identifier: BSD-3-Clause
#include "engine/chunks.hpp"

#include <algorithm>

#include "engine/pair_batch.hpp"

namespace breccia {

Chunks make_chunks(const State& s) {
  const auto& first = s.pairs.i;
  Chunks c{{}, {}};
  for (std::size_t p = 0; p < s.particles.size(); p += particle_block) {
    const auto row = [&](std::size_t particle) {
      return std::size_t(std::lower_bound(first.begin(), first.end(), Index(particle)) - first.begin());
    };
    c.block_start.push_back(c.start.size());
    const std::size_t end = row(std::min(s.particles.size(), p + particle_block));
    for (std::size_t k = row(p); k < end; k += PairBatch::chunk) c.start.push_back(k);
  }
  c.block_start.push_back(c.start.size());
  c.start.push_back(first.size());
  return c;
}

}  // namespace breccia
