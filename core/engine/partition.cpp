// SPDX-License-Identifier: BSD-3-Clause
#include "engine/partition.hpp"

#include <algorithm>

namespace breccia {

Partition make_partition(const State& s, const Incidence& in, const Chunks& chunks, int threads) {
  const std::size_t pairs = s.pairs.size(), n = std::size_t(threads);
  const Index particles = Index(s.particles.size());
  Partition p;
  p.shares.resize(n);
  p.apart.assign(particles, 0);
  p.chunk_cut.assign(chunks.size(), PairBatch::whole);
  for (std::size_t t = 0; t < n; ++t) {
    p.shares[t].first_chunk = chunks.size() * t / n;
    p.shares[t].first_pair = chunks.start[p.shares[t].first_chunk];
    p.shares[t].end_pair = chunks.start[chunks.size() * (t + 1) / n];
  }
  for (std::size_t t = 1; t < n; ++t) {
    const std::size_t first = p.shares[t].first_pair;
    p.shares[t].first_particle = p.shares[t - 1].end_particle = first < pairs ? s.pairs.i[first] : particles;
  }
  p.shares.back().end_particle = particles;
  if (n == 1) return p;
  std::size_t size = 0;
  for (Share& share : p.shares)
    for (Index a = share.first_particle; a < share.end_particle; ++a) {
      const std::size_t begin = in.start[a], end = in.start[a + 1];
      if (begin == end || (in.entry[begin] >> 1 >= share.first_pair && in.entry[end - 1] >> 1 < share.end_pair))
        continue;
      share.apart.push_back(a);
      p.apart[a] = 1;
      for (std::size_t e = begin; e < end; ++e) {
        const std::size_t pair = in.entry[e] >> 1;
        const auto next = std::upper_bound(chunks.start.begin(), chunks.start.end(), pair);
        const std::size_t chunk = std::size_t(next - chunks.start.begin()) - 1, first = chunks.start[chunk];
        if (p.chunk_cut[chunk] == PairBatch::whole) {
          p.chunk_cut[chunk] = Index(size);
          size += chunks.start[chunk + 1] - first;
        }
        share.cut.push_back(p.chunk_cut[chunk] + Index(pair - first));
      }
    }
  p.cut.resize(size);
  return p;
}

}  // namespace breccia
