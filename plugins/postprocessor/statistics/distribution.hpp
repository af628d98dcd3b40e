// SPDX-License-Identifier: BSD-3-Clause
/// Moments and histogram of a set of numbers, of which each part of a specimen has some. They come sorted; sums are
/// exact, so that results do not depend on who is numbered first, nor on how many parts there are.
#pragma once

#include <cstddef>
#include <vector>

#include "breccia/views.hpp"

namespace breccia {

/// In units of the numbers; NaN where not defined: the deviation of a single number, the shape of equal numbers.
struct Moments {
  std::size_t count = 0;
  double mean, median;
  double standard_deviation;  ///< s, with divisor n - 1
  double skewness;            ///< m3/s^3; m_k: central moment with divisor n
  double kurtosis;            ///< m4/s^4 - 3: 0 of the normal distribution
  double min, max;
};

/// Of numbers in ascending order; at least one part has one, and all ask together. Source: Joanes and Gill (1998), The
/// Statistician 47, 183-189, where these are b1 and b2.
Moments moments(const SeenInPart& parts, const std::vector<double>& sorted);

struct Histogram {
  std::vector<double> edges;        ///< one more than bins
  std::vector<std::size_t> counts;  ///< edges[k] <= x < edges[k + 1]; the last bin has its upper edge too
};

/// Bins of equal width between the least and the largest of such numbers. A single bin when they are equal, up to
/// rounding.
Histogram histogram(const SeenInPart& parts, const std::vector<double>& sorted, std::size_t bins);

}  // namespace breccia
