// SPDX-License-Identifier: BSD-3-Clause
#include "distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/error.hpp"

namespace breccia {

Moments moments(const std::vector<double>& sorted) {
  BRECCIA_ASSERT(!sorted.empty());
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const std::size_t count = sorted.size();
  const double n = double(count);
  Moments m{count, 0, 0, undefined, undefined, undefined, sorted.front(), sorted.back()};
  m.median = count % 2 ? sorted[count / 2] : 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]);
  double sum = 0;
  for (const double x : sorted) sum += x - m.min;  // from the least: the mean of equal numbers is exact
  m.mean = m.min + sum / n;
  double second = 0, third = 0, fourth = 0;
  for (const double x : sorted) {
    const double d = x - m.mean;
    second += d * d;
    third += d * d * d;
    fourth += d * d * d * d;
  }
  if (count == 1) return m;
  const double variance = second / (n - 1);
  m.standard_deviation = std::sqrt(variance);
  if (variance == 0) return m;
  m.skewness = third / n / (variance * m.standard_deviation);
  m.kurtosis = fourth / n / (variance * variance) - 3;
  return m;
}

Histogram histogram(const std::vector<double>& sorted, std::size_t bins) {
  BRECCIA_ASSERT(!sorted.empty() && bins > 0);
  const double least = sorted.front(), range = sorted.back() - least;
  // Edges that differ by rounding alone would part numbers that are the same.
  if (range <= 1e-12 * std::max(std::abs(least), std::abs(sorted.back()))) bins = 1;
  Histogram h;
  for (std::size_t k = 0; k < bins; ++k) h.edges.push_back(least + range * (double(k) / double(bins)));
  h.edges.push_back(sorted.back());
  auto begin = sorted.begin();
  for (std::size_t k = 1; k <= bins; ++k) {
    const auto end = k < bins ? std::lower_bound(begin, sorted.end(), h.edges[k]) : sorted.end();
    h.counts.push_back(std::size_t(end - begin));
    begin = end;
  }
  return h;
}

}  // namespace breccia
