// SPDX-License-Identifier: BSD-3-Clause
/// What a workflow says of the radii: distributions by their moments and by sieves, and every refusal.
#include <gtest/gtest.h>

#include <cmath>

#include "breccia/packing_tools/radius_distribution.hpp"
#include "plugin_under_test.hpp"

namespace breccia {
namespace {

struct Moments {
  double mean = 0, deviation = 0, skewness = 0, kurtosis = 0;
};
Moments moments(const std::vector<double>& r) {
  const double n = double(r.size());
  double sum = 0, second = 0, third = 0, fourth = 0;
  for (const double x : r) sum += x;
  const double mean = sum / n;
  for (const double x : r) {
    const double d = x - mean;
    second += d * d / n;
    third += d * d * d / n;
    fourth += d * d * d * d / n;
  }
  const double deviation = std::sqrt(second);
  return {mean, deviation, third / (second * deviation), fourth / (second * second) - 3};
}

RadiusConfig by_moments(DistributionFamily kind, double mean, double deviation, double min, double max) {
  RadiusConfig c;
  c.distribution = kind;
  c.mean = mean;
  c.standard_deviation = deviation;
  c.min = min;
  c.max = max;
  return c;
}

RadiusConfig sieves(std::vector<SieveRow> rows) {
  RadiusConfig c;
  c.distribution = DistributionFamily::sieves;
  c.sieves = std::move(rows);
  return c;
}

TEST(DistributionFamily, WeibullHasMeanAndDeviation) {
  for (const double deviation : {0.1, 0.3}) {
    const Moments m =
        moments(quantile_radii(by_moments(DistributionFamily::weibull, 1, deviation, 0.3, 2).law(), 2000));
    EXPECT_NEAR(m.mean, 1, 1e-9);
    EXPECT_NEAR(m.deviation, deviation, 1e-9);
  }
}

TEST(DistributionFamily, WeibullHasItsShape) {
  // Hardly cut: skewness of a Weibull variable of shape 2 (Rayleigh) is 2 sqrt(pi) (pi - 3)/(4 - pi)^1.5 = 0.6311,
  // its deviation sqrt(4/pi - 1) = 0.52272 of the mean.
  const Moments m = moments(quantile_radii(by_moments(DistributionFamily::weibull, 1, 0.52272, 1e-4, 6).law(), 20000));
  EXPECT_NEAR(m.skewness, 0.6311, 2e-3);
}

TEST(DistributionFamily, MomentsMeetsAllFour) {
  // Rojek et al. (2012), Table A.2 [mm].
  RadiusConfig c = by_moments(DistributionFamily::moments, 0.6993391, 0.3252012, 0.1151885, 1.2399406);
  c.skewness = -0.0103777;
  c.kurtosis = -1.2784650;
  const auto r = quantile_radii(c.law(), 5868);
  const Moments m = moments(r);
  EXPECT_NEAR(m.mean, 0.6993391, 1e-6);
  EXPECT_NEAR(m.deviation, 0.3252012, 1e-6);
  EXPECT_NEAR(m.skewness, -0.0103777, 1e-5);
  EXPECT_NEAR(m.kurtosis, -1.2784650, 1e-5);
  EXPECT_GE(r.front(), 0.1151885);
  EXPECT_LE(r.back(), 1.2399406);
  EXPECT_LT(r.back() - r.front(), 1.2399406 - 0.1151885);
}

TEST(DistributionFamily, MomentsOfMeanAndDeviationAloneIsTheCutNormal) {
  // Of all densities on an interval with given mean and variance the one of largest entropy is exp(a + b r + c r^2).
  const auto entropy = quantile_radii(by_moments(DistributionFamily::moments, 1, 0.25, 0.5, 1.6).law(), 1000);
  const auto normal = quantile_radii(by_moments(DistributionFamily::normal, 1, 0.25, 0.5, 1.6).law(), 1000);
  for (std::size_t k = 0; k < entropy.size(); ++k) ASSERT_NEAR(entropy[k], normal[k], 2e-6) << k;
}

TEST(DistributionFamily, SievesPassTheMassOfTheirTable) {
  const std::vector<SieveRow> table = {{1e-3, 0}, {2e-3, 0.3}, {3e-3, 0.3}, {4e-3, 0.8}, {8e-3, 1}};
  const auto r = quantile_radii(sieves(table).law(), 200000);
  double all = 0;
  for (const double x : r) all += x * x * x;
  for (const SieveRow& row : table) {
    double passing = 0;
    for (const double x : r) passing += 2 * x <= row.size ? x * x * x : 0;
    EXPECT_NEAR(passing / all, row.passing, 1e-3) << row.size;
  }
  // Linear between two sieves: half the mass between 4 and 8 mm is below 6 mm.
  double passing = 0;
  for (const double x : r) passing += 2 * x <= 6e-3 ? x * x * x : 0;
  EXPECT_NEAR(passing / all, 0.9, 1e-3);
}

TEST(DistributionFamily, RowsWithoutParticlesDoNotWidenTheLimits) {
  const RadiusLaw law = sieves({{1e-3, 0}, {2e-3, 0}, {4e-3, 1}, {8e-3, 1}}).law();
  EXPECT_EQ(law.min, 1e-3);
  EXPECT_EQ(law.max, 2e-3);
}

TEST(DistributionFamily, EveryMistakeIsNamed) {
  const auto expect = [](const RadiusConfig& c, const std::string& part) {
    const std::string text = test::user_error([&] { c.law(); });
    EXPECT_NE(text.find(part), std::string::npos) << "got: " << text;
  };
  const RadiusConfig good = by_moments(DistributionFamily::normal, 1, 0.2, 0.5, 1.6);
  EXPECT_NO_THROW(good.law());
  RadiusConfig c = good;
  c.sieves = {{1e-3, 0}, {2e-3, 1}};
  expect(c, "sieves belong to distribution: sieves");
  c = good;
  c.skewness = 0.1;
  expect(c, "skewness and kurtosis belong to distribution: moments");
  c = good;
  c.distribution = DistributionFamily::moments;
  c.kurtosis = -1;
  expect(c, "kurtosis needs skewness");
  c.skewness = 2;  // kurtosis is never below skewness^2 - 2
  expect(c, "no distribution of this kind");
  c = good;
  c.min = 1.7;
  expect(c, "min is larger than max");
  c = good;
  c.mean = 1.7;
  expect(c, "the mean is not between min and max");
  c = good;
  c.standard_deviation.reset();
  expect(c, "this distribution needs mean and standard_deviation");
  c = good;
  c.standard_deviation = 0.6;
  expect(c, "no distribution of this kind");
  c = RadiusConfig{};
  c.distribution = DistributionFamily::uniform;
  c.min = 1;
  expect(c, "a uniform distribution needs min and max, or mean and standard_deviation");
  c.mean = 1.2;
  c.standard_deviation = 0.1;
  expect(c, "needs both min and max, or neither");
  c.max = 2;
  expect(c, "follows from min and max alone");
  c.min.reset();
  c.max.reset();
  c.standard_deviation = 0.9;
  expect(c, "gives radii below zero");
  c = sieves({{1e-3, 0}, {2e-3, 1}});
  EXPECT_NO_THROW(c.law());
  c.mean = 1;
  expect(c, "is given by sieves, and by nothing else");
  expect(sieves({{1e-3, 0}, {1e-3, 1}}), "sizes must rise");
  expect(sieves({{1e-3, 0}, {2e-3, 0.6}, {3e-3, 0.5}, {4e-3, 1}}), "passing must not fall");
  expect(sieves({{1e-3, 0.1}, {2e-3, 1}}), "passing must begin with 0 %");
  expect(sieves({{1e-3, 0}, {2e-3, 0.9}}), "end with 100 %");
}

}  // namespace
}  // namespace breccia
