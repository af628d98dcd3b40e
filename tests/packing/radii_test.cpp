// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"
#include "breccia/packing_tools/radius_distribution.hpp"

namespace breccia::labra_onate {
namespace {

double mean(const std::vector<double>& r, int power = 1, double about = 0) {
  double sum = 0;
  for (const double x : r) sum += std::pow(x - about, power);
  return sum / double(r.size());
}

void expect_moments(const RadiusLaw& law, std::size_t n, double tolerance) {
  const auto r = quantile_radii(law, n);
  ASSERT_EQ(r.size(), n);
  EXPECT_TRUE(std::is_sorted(r.begin(), r.end()));
  EXPECT_GE(r.front(), law.min);
  EXPECT_LE(r.back(), law.max);
  EXPECT_NEAR(mean(r), law.mean, tolerance * law.mean);
  EXPECT_NEAR(std::sqrt(mean(r, 2, mean(r))), law.standard_deviation, tolerance * law.standard_deviation);
}

TEST(Radii, NormalHasTheMomentsOfTheCutDistribution) {
  expect_moments({DistributionFamily::normal, 0.675935e-3, 0.1346085e-3, 0.3122622e-3, 1.186122e-3}, 10225, 1e-9);
}
TEST(Radii, AStronglyCutNormalStillHasThem) {
  expect_moments({DistributionFamily::normal, 1.0, 0.3, 0.5, 1.6}, 3000, 1e-9);
}
TEST(Radii, LognormalHasThem) { expect_moments({DistributionFamily::lognormal, 1.0, 0.3, 0.3, 3.0}, 3000, 1e-9); }
TEST(Radii, OneHundredAreEnoughForThem) { expect_moments({DistributionFamily::normal, 1.0, 0.2, 0.4, 1.8}, 100, 1e-9); }

TEST(Radii, UniformSpreadsEvenly) {
  const auto r = quantile_radii({DistributionFamily::uniform, 1.0, 0.5 / std::sqrt(3.0), 0.5, 1.5}, 4);
  ASSERT_EQ(r.size(), 4u);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(r[k], 0.625 + 0.25 * k, 1e-14);
}

TEST(Radii, AWideNormalHasTheQuantilesOfTheTables) {
  // Standard normal quantiles: Abramowitz & Stegun, table 26.1.
  const auto r = quantile_radii({DistributionFamily::normal, 100, 1, 90, 110}, 20001);
  EXPECT_NEAR(r[10000], 100, 1e-6);
  EXPECT_NEAR(r[19500], 101.959964, 2e-3);
  EXPECT_NEAR(r[19900], 102.575829, 4e-3);
}

TEST(Radii, WithoutSpreadAllAreEqual) {
  for (const double r : quantile_radii({DistributionFamily::normal, 2.0, 0, 1, 3}, 7)) EXPECT_EQ(r, 2.0);
}

TEST(Radii, OneRadiusIsInsideTheLimits) {
  const auto r = quantile_radii({DistributionFamily::normal, 1.0, 0.2, 0.4, 1.8}, 1);
  EXPECT_NEAR(r.at(0), 1.0, 0.05);
}

TEST(Radii, AnImpossibleSpreadIsRefused) {
  EXPECT_THROW(quantile_radii({DistributionFamily::normal, 1.0, 0.5, 0.9, 1.1}, 100), UserError);
}

}  // namespace
}  // namespace breccia::labra_onate
