// SPDX-License-Identifier: BSD-3-Clause
/// A sum of numbers that is exact until it is asked for: the same bits in whatever order, and in however many parts,
/// they are added.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace breccia {

/// Fixed-point number that holds every double and every sum of 2^60 of them, as digits of 32 bits with room for carries
/// (Kulisch's long accumulator). Nothing but whole numbers, so that those of several machines are added one by one.
class ExactSum {
 public:
  static constexpr std::size_t words = 72;

  void add(double value);
  /// Rounded once, to the nearest double. NaN and infinities come out as a plain sum would have them.
  double value() const;
  /// Afterwards words may be added to those of others.
  void carry();

 private:
  static constexpr std::size_t digits = 68, nan = 68, plus_infinity = 69, minus_infinity = 70, pending = 71;
  std::int64_t word_[words] = {};
};
static_assert(sizeof(ExactSum) == ExactSum::words * sizeof(std::int64_t));

class RankLink;

/// The values of several sums; of a specimen in parts, whose own part each rank has added, those of the whole. `link`:
/// null where there is but one part. All ranks ask together.
std::vector<double> totals(std::span<ExactSum> sums, RankLink* link);

}  // namespace breccia
