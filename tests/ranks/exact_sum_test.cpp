// SPDX-License-Identifier: BSD-3-Clause
// Sums that are exact until they are rounded once.
#include "engine/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace breccia {
namespace {

double sum_of(const std::vector<double>& values) {
  ExactSum s;
  for (const double v : values) s.add(v);
  return s.value();
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(ExactSum, OfOneNumberIsThatNumber) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    const std::uint64_t bits = random();
    double v;
    std::memcpy(&v, &bits, sizeof v);
    if (!std::isfinite(v)) continue;
    ASSERT_TRUE(same_bits(sum_of({v}), v)) << v;
  }
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  for (const double v : {least, -least, most, -most, std::numeric_limits<double>::min(), 0.0})
    EXPECT_TRUE(same_bits(sum_of({v}), v)) << v;
}

TEST(ExactSum, KeepsWhatAPlainSumLoses) {
  EXPECT_EQ(sum_of({1e300, 1, -1e300}), 1);
  EXPECT_EQ(sum_of({1, 1e-300, -1}), 1e-300);
  EXPECT_EQ(sum_of({0.1, 0.2, -0.3}), 0x1p-55);  // of the doubles nearest to them
  const double most = std::numeric_limits<double>::max();
  EXPECT_EQ(sum_of({most, most, -most}), most);
  EXPECT_EQ(sum_of({-most, -most, most, most}), 0);
}

TEST(ExactSum, RoundsOnceToTheNearestAndHalvesToTheEvenOne) {
  EXPECT_EQ(sum_of({1, 0x1p-53}), 1);                       // half way: to the even one
  EXPECT_EQ(sum_of({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);   // half way: up to the even one
  EXPECT_EQ(sum_of({1, 0x1p-53, 0x1p-1000}), 1 + 0x1p-52);  // a hair above half way
  EXPECT_EQ(sum_of({1, 0x1p-53, -0x1p-1000}), 1);           // a hair below
  EXPECT_EQ(sum_of({-1, -0x1p-53, -0x1p-1000}), -(1 + 0x1p-52));
  EXPECT_EQ(sum_of({0x1.fffffffffffffp0, 0x1p-53}), 2);  // carries into the next power
}

TEST(ExactSum, IsTheSameInWhateverOrderAndParts) {
  std::mt19937_64 random(7);
  std::vector<double> values;
  for (int k = 0; k < 4000; ++k)
    values.push_back(std::ldexp(double(random() >> 11) * 0x1p-53 - 0.5, int(random() % 1200) - 600));
  const double all = sum_of(values);
  for (int turn = 0; turn < 5; ++turn) {
    std::shuffle(values.begin(), values.end(), random);
    EXPECT_TRUE(same_bits(sum_of(values), all));
  }
  // Their words may be added one by one, as ranks do.
  std::vector<ExactSum> parts(3);
  for (std::size_t k = 0; k < values.size(); ++k) parts[k % 3].add(values[k]);
  ExactSum together;
  for (ExactSum& p : parts) {
    p.carry();
    auto* to = reinterpret_cast<std::int64_t*>(&together);
    const auto* from = reinterpret_cast<const std::int64_t*>(&p);
    for (std::size_t w = 0; w < ExactSum::words; ++w) to[w] += from[w];
  }
  EXPECT_TRUE(same_bits(together.value(), all));
}

/// Against 128-bit whole numbers, which are exact where they do not overflow.
TEST(ExactSum, AgreesWithWholeNumbers) {
  std::mt19937_64 random(3);
  for (int turn = 0; turn < 2000; ++turn) {
    std::vector<double> values;
    __int128 exact = 0;
    for (int k = 0; k < 20; ++k) {
      const int shift = int(random() % 50);
      const auto whole = std::int64_t(random() >> 12) - (std::int64_t(1) << 51);
      values.push_back(std::ldexp(double(whole), shift));
      exact += __int128(whole) << shift;
    }
    EXPECT_EQ(sum_of(values), double(exact));  // the conversion rounds to the nearest, halves to the even one
  }
}

TEST(ExactSum, SaysInfinitiesAndWhatIsNoNumber) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sum_of({1, infinity}), infinity);
  EXPECT_EQ(sum_of({-infinity, 1e308}), -infinity);
  EXPECT_TRUE(std::isnan(sum_of({infinity, -infinity})));
  EXPECT_TRUE(std::isnan(sum_of({1, std::nan("")})));
  EXPECT_EQ(sum_of({std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}), infinity);
}

}  // namespace
}  // namespace breccia
