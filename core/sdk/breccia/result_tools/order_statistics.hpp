// SPDX-License-Identifier: BSD-3-Clause
/// The n-th smallest of numbers that nobody has all of.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace breccia {

/// Whole numbers in the order of the doubles.
inline std::uint64_t place_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63 ? ~bits : bits | std::uint64_t(1) << 63;
}
inline double value_at(std::uint64_t place) {
  return std::bit_cast<double>(place >> 63 ? place & ~(std::uint64_t(1) << 63) : ~place);
}

/// For each of `before` the number of all ranks that has so many smaller ones or as small. By halves: some 64 messages,
/// each of as many counts. `numbers`: those that are here; `total(counts)` adds each up over all ranks, which call this
/// together. No NaN.
template <class Total>
std::vector<double> numbers_behind(std::vector<double> numbers, std::span<const std::size_t> before, Total&& total) {
  std::sort(numbers.begin(), numbers.end(), [](double a, double b) { return place_of(a) < place_of(b); });
  struct Range {
    std::uint64_t low = 0, high = ~std::uint64_t(0);
    std::uint64_t middle() const { return low + (high - low) / 2; }
  };
  std::vector<Range> ranges(before.size());
  std::vector<std::int64_t> not_above(before.size());
  while (std::any_of(ranges.begin(), ranges.end(), [](const Range& r) { return r.low < r.high; })) {
    for (std::size_t k = 0; k < ranges.size(); ++k)
      not_above[k] = std::upper_bound(numbers.begin(), numbers.end(), ranges[k].middle(),
                                      [](std::uint64_t place, double number) { return place < place_of(number); }) -
                     numbers.begin();
    total(std::span<std::int64_t>(not_above));
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      Range& r = ranges[k];
      if (r.low == r.high) continue;
      if (std::size_t(not_above[k]) > before[k]) r.high = r.middle();
      else r.low = r.middle() + 1;
    }
  }
  std::vector<double> found;
  for (const Range& r : ranges) found.push_back(value_at(r.low));
  return found;
}

}  // namespace breccia
