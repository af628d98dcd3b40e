// SPDX-License-Identifier: BSD-3-Clause
#include "distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/error.hpp"
#include "breccia/result_tools/order_statistics.hpp"

namespace breccia {

namespace {

struct Ends {
  double least = std::numeric_limits<double>::infinity(), most = -least;
};

Ends ends_of(const SeenInPart& parts, const std::vector<double>& sorted) {
  Ends e;
  if (!sorted.empty()) e = {sorted.front(), sorted.back()};
  double most[] = {-e.least, e.most};
  parts.max(most);
  return {-most[0], most[1]};
}

double median_of(const SeenInPart& parts, const std::vector<double>& sorted, std::size_t count) {
  const std::size_t middle[] = {(count - 1) / 2, count / 2};
  if (!parts.part) return 0.5 * (sorted[middle[0]] + sorted[middle[1]]);
  const std::vector<double> at = numbers_behind(sorted, middle, [&](std::span<std::int64_t> counts) {
    std::vector<ExactSum> sums(counts.size());
    for (std::size_t k = 0; k < counts.size(); ++k) sums[k].add(double(counts[k]));
    const std::vector<double> all = parts.sums(sums);
    std::copy(all.begin(), all.end(), counts.begin());
  });
  return 0.5 * (at[0] + at[1]);
}

}  // namespace

Moments moments(const SeenInPart& parts, const std::vector<double>& sorted) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  const Ends ends = ends_of(parts, sorted);
  ExactSumOf<std::size_t> number;
  ExactSumOf<double> above;  // the least: the mean of equal numbers is exact
  number.add(sorted.size());
  for (const double x : sorted) above.add(x - ends.least);
  const auto [count, sum] = parts.sum(number, above);
  BRECCIA_ASSERT(count > 0);
  const double n = double(count);
  Moments m{count, 0, 0, undefined, undefined, undefined, ends.least, ends.most};
  m.median = median_of(parts, sorted, count);
  m.mean = m.min + sum / n;
  ExactSumOf<Eigen::Vector3d> powers;
  for (const double x : sorted) {
    const double d = x - m.mean;
    powers.add({d * d, d * d * d, d * d * d * d});
  }
  const Eigen::Vector3d of = parts.sum(powers);
  const double second = of[0], third = of[1], fourth = of[2];
  if (count == 1) return m;
  const double variance = second / (n - 1);
  m.standard_deviation = std::sqrt(variance);
  if (variance == 0) return m;
  m.skewness = third / n / (variance * m.standard_deviation);
  m.kurtosis = fourth / n / (variance * variance) - 3;
  return m;
}

Histogram histogram(const SeenInPart& parts, const std::vector<double>& sorted, std::size_t bins) {
  BRECCIA_ASSERT(bins > 0);
  const auto [least, most] = ends_of(parts, sorted);
  const double range = most - least;
  // Edges that differ by rounding alone would part numbers that are the same.
  if (range <= 1e-12 * std::max(std::abs(least), std::abs(most))) bins = 1;
  Histogram h;
  for (std::size_t k = 0; k < bins; ++k) h.edges.push_back(least + range * (double(k) / double(bins)));
  h.edges.push_back(most);
  std::vector<ExactSum> counts(bins);
  auto begin = sorted.begin();
  for (std::size_t k = 1; k <= bins; ++k) {
    const auto end = k < bins ? std::lower_bound(begin, sorted.end(), h.edges[k]) : sorted.end();
    counts[k - 1].add(double(end - begin));
    begin = end;
  }
  for (const double count : parts.sums(counts)) h.counts.push_back(std::size_t(count));
  return h;
}

}  // namespace breccia
