// SPDX-License-Identifier: BSD-3-Clause
#include "engine/partition.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace breccia {

static const double first_deal = std::getenv("FD") ? std::atof(std::getenv("FD")) : 1.0;
static const int later_shares = first_deal < 1 ? (std::getenv("LS") ? std::atoi(std::getenv("LS")) : 2) : 0;

std::vector<double> share_ends(int threads) {
  std::vector<double> ends;
  if (threads == 1) return {1.0};
  for (int t = 1; t <= threads; ++t) ends.push_back(first_deal * t / threads);
  const int rest = later_shares * threads;
  for (int t = 1; t <= rest; ++t) ends.push_back(first_deal + (1 - first_deal) * t / rest);
  ends.back() = 1;
  return ends;
}

Partition make_partition(const State& s, const Incidence& in, const Chunks& chunks, int threads) {
  const std::vector<double> ends = share_ends(threads);
  const std::size_t pairs = s.pairs.size(), n = ends.size();
  const auto chunk_at = [&](std::size_t share) {
    return share == 0 ? 0 : std::size_t(std::llround(ends[share - 1] * double(chunks.size())));
  };
  const Index particles = Index(s.particles.size());
  Partition p;
  p.shares.resize(n);
  p.apart.assign(particles, 0);
  p.chunk_apart.assign(chunks.size(), 0);
  for (std::size_t t = 0; t < n; ++t) {
    p.shares[t].first_chunk = chunk_at(t);
    p.shares[t].first_pair = chunks.start[chunk_at(t)];
    p.shares[t].end_pair = chunks.start[chunk_at(t + 1)];
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
      for (std::size_t e = begin; e < end; ++e) {
        const std::size_t pair = in.entry[e] >> 1;
        const auto next = std::upper_bound(chunks.start.begin(), chunks.start.end(), pair);
        p.chunk_apart[std::size_t(next - chunks.start.begin()) - 1] = 1;
      }
    }
  return p;
}

}  // namespace breccia
