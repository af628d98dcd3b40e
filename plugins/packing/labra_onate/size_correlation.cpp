// SPDX-License-Identifier: BSD-3-Clause
#include "size_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace breccia::labra_onate {

double size_correlation(const Spheres& s, const NeighbourSet& set) {
  double sum = 0, square = 0, product = 0, count = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (const Index j : set.row(i)) {
      sum += s.r[i];
      square += s.r[i] * s.r[i];
      product += s.r[i] * s.r[j];
      ++count;
    }
  if (count == 0) return 0;
  const double mean = sum / count, variance = square / count - mean * mean;
  return variance > 1e-20 * mean * mean ? (product / count - mean * mean) / variance : 0;
}

void correlate_sizes(Spheres& s, const NeighbourSet& set, double wanted, std::uint64_t seed) {
  const std::size_t n = s.size();
  if (n < 2 || set.pairs() == 0) return;
  const double sense = size_correlation(s, set) < wanted ? 1 : -1;
  const auto reached = [&] { return sense * (size_correlation(s, set) - wanted) >= 0; };
  std::mt19937_64 generator(seed);
  const auto pick = [&] { return std::min(n - 1, std::size_t(double(generator() >> 11) * 0x1p-53 * double(n))); };
  const auto around = [&](std::size_t i, std::size_t but) {
    double sum = 0;
    for (const Index j : set.row(i))
      if (j != but) sum += s.r[j];
    return sum;
  };
  const std::size_t look_every = std::max<std::size_t>(1, n / 100);
  std::size_t in_vain = 0;
  while (!reached() && in_vain < 20 * n) {
    for (std::size_t accepted = 0; accepted < look_every && in_vain < 20 * n;) {
      const std::size_t a = pick(), b = pick();
      const auto degree = [&](std::size_t i) { return std::ptrdiff_t(set.row(i).size()); };
      // The change of the sum of products of neighbouring radii.
      const double gain = (s.r[b] - s.r[a]) * (around(a, b) - around(b, a));
      if (a == b || std::abs(degree(a) - degree(b)) > 1 || !(sense * gain > 0)) {
        ++in_vain;
        continue;
      }
      std::swap(s.r[a], s.r[b]);
      ++accepted;
      in_vain = 0;
    }
  }
}

}  // namespace breccia::labra_onate
