// SPDX-License-Identifier: BSD-3-Clause
/// A sum of numbers that is exact until it is asked for: the same bits in whatever order, and in however many parts,
/// they are added.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace breccia {

/// Fixed-point number that holds every double and every sum of 2^60 of them, as digits of 32 bits with room for carries
/// (Kulisch's long accumulator). Nothing but whole numbers, so that those of several machines are added one by one.
class ExactSum {
 public:
  static constexpr std::size_t words = 72;

  void add(double value);
  void add(ExactSum other) {
    carry();
    other.carry();
    for (std::size_t k = 0; k < words; ++k) word_[k] += other.word_[k];
  }
  /// Rounded once, to the nearest double. NaN and infinities come out as a plain sum would have them.
  double value() const;
  /// Afterwards words may be added to those of others.
  void carry() {
    carry_up(word_);
    word_[pending] = 0;
  }

 private:
  static constexpr std::size_t digits = 68, nan = 68, plus_infinity = 69, minus_infinity = 70, pending = 71;
  static constexpr std::int64_t digit = 0xffffffff;
  static constexpr int lowest = -1074;                         // exponent of the last bit of the first digit
  static constexpr std::int64_t most = std::int64_t(1) << 30;  // additions before a word could overflow

  /// The last digit keeps the sign.
  static void carry_up(std::int64_t* word) {
    std::int64_t over = 0;
    for (std::size_t k = 0; k + 1 < digits; ++k) {
      const std::int64_t sum = word[k] + over;
      word[k] = sum & digit;
      over = sum >> 32;
    }
    word[digits - 1] += over;
  }

  std::int64_t word_[words] = {};
};
static_assert(sizeof(ExactSum) == ExactSum::words * sizeof(std::int64_t));

inline void ExactSum::add(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int exponent = int(bits >> 52 & 0x7ff);
  std::uint64_t mantissa = bits & 0xfffffffffffff;
  const bool minus = bits >> 63;
  if (exponent == 0x7ff) {
    ++word_[mantissa ? nan : minus ? minus_infinity : plus_infinity];
    return;
  }
  if (exponent > 0) mantissa |= std::uint64_t(1) << 52;
  const unsigned place = exponent > 0 ? unsigned(exponent - 1) : 0, k = place / 32, shift = place % 32;
  const std::uint64_t low = mantissa << shift, high = shift > 11 ? mantissa >> (64 - shift) : 0;
  const std::int64_t a = std::int64_t(low) & digit, b = std::int64_t(low >> 32), c = std::int64_t(high);
  word_[k] += minus ? -a : a;
  word_[k + 1] += minus ? -b : b;
  word_[k + 2] += minus ? -c : c;
  if (++word_[pending] == most) carry();
}

inline double ExactSum::value() const {
  __extension__ using Wide = unsigned __int128;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (word_[nan] || (word_[plus_infinity] && word_[minus_infinity])) return std::numeric_limits<double>::quiet_NaN();
  if (word_[plus_infinity] || word_[minus_infinity]) return word_[plus_infinity] ? infinity : -infinity;
  std::int64_t word[digits];
  std::copy(word_, word_ + digits, word);
  carry_up(word);
  const bool minus = word[digits - 1] < 0;
  if (minus) {
    for (std::int64_t& w : word) w = -w;
    carry_up(word);
  }
  std::size_t top = digits;
  while (top > 0 && word[top - 1] == 0) --top;
  if (top == 0) return 0;
  // The three highest digits hold at least 65 bits, of which 53 are kept; of the others it matters whether any is set.
  Wide wide = 0;
  for (std::size_t k = 0; k < 3; ++k) wide = wide << 32 | std::uint64_t(top > k ? word[top - 1 - k] : 0);
  bool rest = false;
  for (std::size_t k = 0; k + 3 < top; ++k) rest |= word[k] != 0;
  int bits = 0;
  for (Wide w = wide; w; w >>= 1) ++bits;
  const int drop = std::max(0, bits - 53);
  std::uint64_t kept = std::uint64_t(wide >> drop);
  if (drop > 0) {
    const Wide half = Wide(1) << (drop - 1), off = wide & (2 * half - 1);
    if (off > half || (off == half && (rest || (kept & 1)))) ++kept;
  }
  const double size = std::ldexp(double(kept), drop + 32 * (int(top) - 3) + lowest);
  return minus ? -size : size;
}

/// The same of numbers, counts, vectors or matrices (Eigen's, of fixed size), component by component.
template <class T>
class ExactSumOf {
 public:
  static constexpr std::size_t size = [] {
    if constexpr (std::is_arithmetic_v<T>) return std::size_t(1);
    else return std::size_t(T::SizeAtCompileTime);
  }();

  void add(const T& term) {
    if constexpr (std::is_arithmetic_v<T>) sums_[0].add(double(term));
    else
      for (std::size_t k = 0; k < size; ++k) sums_[k].add(term.data()[k]);
  }
  const std::array<ExactSum, size>& sums() const { return sums_; }
  /// What `size` values make.
  static T of(const double* values) {
    if constexpr (std::is_arithmetic_v<T>) {
      return T(values[0]);
    } else {
      T result;
      std::copy(values, values + size, result.data());
      return result;
    }
  }

 private:
  std::array<ExactSum, size> sums_;
};

}  // namespace breccia
