// SPDX-License-Identifier: BSD-3-Clause
#include "engine/partition.hpp"

#include <algorithm>

#include "engine/pair_batch.hpp"

namespace breccia {

Partition make_partition(const State& s, const Incidence& in, int threads) {
  constexpr std::size_t chunk = PairBatch::chunk;
  const std::size_t pairs = s.pairs.size(), chunks = (pairs + chunk - 1) / chunk, n = std::size_t(threads);
  const Index particles = Index(s.particles.size());
  Partition p;
  p.shares.resize(n);
  p.apart.assign(particles, 0);
  p.chunk_apart.assign(chunks, 0);
  for (std::size_t t = 0; t < n; ++t) {
    p.shares[t].first_pair = std::min(pairs, chunk * (chunks * t / n));
    p.shares[t].end_pair = std::min(pairs, chunk * (chunks * (t + 1) / n));
  }
  for (std::size_t t = 1; t < n; ++t) {
    const std::size_t first = p.shares[t].first_pair;
    p.shares[t].first_particle = p.shares[t - 1].end_particle = first < pairs ? s.pairs.i[first] : particles;
  }
  p.shares.back().end_particle = particles;
  if (n == 1) return p;
  for (Share& share : p.shares)
    for (Index a = share.first_particle; a < share.end_particle; ++a) {
      const std::size_t begin = in.start[a], end = in.start[a + 1];
      if (begin == end || (in.entry[begin] >> 1 >= share.first_pair && in.entry[end - 1] >> 1 < share.end_pair))
        continue;
      share.apart.push_back(a);
      p.apart[a] = 1;
      for (std::size_t e = begin; e < end; ++e) p.chunk_apart[(in.entry[e] >> 1) / chunk] = 1;
    }
  return p;
}

}  // namespace breccia
