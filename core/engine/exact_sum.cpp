// SPDX-License-Identifier: BSD-3-Clause
#include "engine/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/rank_link.hpp"

namespace breccia {
namespace {

constexpr std::int64_t digit = 0xffffffff;
constexpr int lowest = -1074;                         // exponent of the last bit of the first digit
constexpr std::int64_t most = std::int64_t(1) << 30;  // additions before a word could overflow

/// Carries up; the last digit keeps the sign.
void carry_up(std::int64_t* word, std::size_t digits) {
  std::int64_t over = 0;
  for (std::size_t k = 0; k + 1 < digits; ++k) {
    const std::int64_t sum = word[k] + over;
    word[k] = sum & digit;
    over = sum >> 32;
  }
  word[digits - 1] += over;
}

}  // namespace

void ExactSum::add(double value) {
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

void ExactSum::carry() {
  carry_up(word_, digits);
  word_[pending] = 0;
}

double ExactSum::value() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (word_[nan] || (word_[plus_infinity] && word_[minus_infinity])) return std::numeric_limits<double>::quiet_NaN();
  if (word_[plus_infinity] || word_[minus_infinity]) return word_[plus_infinity] ? infinity : -infinity;
  std::int64_t word[digits];
  std::copy(word_, word_ + digits, word);
  carry_up(word, digits);
  const bool minus = word[digits - 1] < 0;
  if (minus) {
    for (std::int64_t& w : word) w = -w;
    carry_up(word, digits);
  }
  std::size_t top = digits;
  while (top > 0 && word[top - 1] == 0) --top;
  if (top == 0) return 0;
  // The three highest digits hold at least 65 bits, of which 53 are kept; of the others it matters whether any is set.
  unsigned __int128 wide = 0;
  for (std::size_t k = 0; k < 3; ++k) wide = wide << 32 | std::uint64_t(top > k ? word[top - 1 - k] : 0);
  bool rest = false;
  for (std::size_t k = 0; k + 3 < top; ++k) rest |= word[k] != 0;
  int bits = 0;
  for (unsigned __int128 w = wide; w; w >>= 1) ++bits;
  const int drop = std::max(0, bits - 53);
  std::uint64_t kept = std::uint64_t(wide >> drop);
  if (drop > 0) {
    const unsigned __int128 half = (unsigned __int128)1 << (drop - 1), off = wide & (2 * half - 1);
    if (off > half || (off == half && (rest || (kept & 1)))) ++kept;
  }
  const double size = std::ldexp(double(kept), drop + 32 * (int(top) - 3) + lowest);
  return minus ? -size : size;
}

std::vector<double> totals(std::span<ExactSum> sums, RankLink* link) {
  if (link && !sums.empty()) {
    for (ExactSum& s : sums) s.carry();
    link->add({reinterpret_cast<std::int64_t*>(sums.data()), sums.size() * ExactSum::words});
  }
  std::vector<double> values;
  for (const ExactSum& s : sums) values.push_back(s.value());
  return values;
}

}  // namespace breccia
