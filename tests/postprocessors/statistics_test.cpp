// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

FakeSummary statistics(const FakeSimulation& s, Json config = Json::object()) {
  LoadedPostprocessor p("statistics", std::move(config));
  EXPECT_TRUE(p.issues.empty());
  p.begin(s.view());
  return p.finish(s.view());
}

FakeSimulation particles(const std::vector<double>& radii) {
  FakeSimulation s;
  for (const double r : radii) s.add_particle(Vec3(double(s.position.size()), 0, 0), r);
  return s;
}

double at(const FakeSummary& summary, const std::string& quantity, const std::string& key) {
  return summary.owned.at(quantity).at(key).get<double>();
}

std::vector<double> column(const Table& table, const std::string& name) {
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].name == name) return table.values[c];
  throw std::logic_error("no column " + name);
}

/// Deviations from the mean 4: -3, -2, -1, 0, 6; sums of their powers: 50, 180, 1394.
TEST(Statistics, OfFiveRadiiByHand) {
  const FakeSummary got = statistics(particles({3, 10, 1, 4, 2}));
  const std::string r = "particle_radius";
  EXPECT_EQ(got.owned.at(r).at("count"), 5);
  EXPECT_DOUBLE_EQ(at(got, r, "mean_m"), 4);
  EXPECT_DOUBLE_EQ(at(got, r, "median_m"), 3);
  EXPECT_DOUBLE_EQ(at(got, r, "std_m"), std::sqrt(50.0 / 4));
  EXPECT_NEAR(at(got, r, "skewness"), 180.0 / 5 / std::pow(12.5, 1.5), 1e-14);
  EXPECT_NEAR(at(got, r, "kurtosis"), 1394.0 / 5 / (12.5 * 12.5) - 3, 1e-14);
  EXPECT_EQ(at(got, r, "min_m"), 1);
  EXPECT_EQ(at(got, r, "max_m"), 10);
  EXPECT_DOUBLE_EQ(at(got, "particle_radius_squared", "mean_m2"), (9 + 100 + 1 + 16 + 4) / 5.0);
  EXPECT_DOUBLE_EQ(at(got, "particle_radius_squared", "median_m2"), 9);
}

TEST(Statistics, PairsAreTheBonds) {
  FakeSimulation s = particles({1, 3, 6});
  s.add_bond(0, 1);
  s.add_bond(1, 2);
  s.add_pair(0, 2);  // not a bond
  s.break_bond(1, BondState::broken_shear);
  const FakeSummary got = statistics(s);
  EXPECT_EQ(got.owned.at("pair_minimum_radius").at("count"), 2);
  const auto both = [&](const std::string& name, double first, double second) {
    EXPECT_DOUBLE_EQ(at(got, name, "min_m"), first) << name;
    EXPECT_DOUBLE_EQ(at(got, name, "max_m"), second) << name;
    EXPECT_DOUBLE_EQ(at(got, name + "_squared", "min_m2"), first * first) << name;
    EXPECT_DOUBLE_EQ(at(got, name + "_squared", "max_m2"), second * second) << name;
    EXPECT_DOUBLE_EQ(at(got, name, "median_m"), (first + second) / 2) << name;
  };
  both("pair_arithmetic_mean_radius", 2, 4.5);
  both("pair_harmonic_mean_radius", 1.5, 4);
  both("pair_minimum_radius", 1, 3);
}

/// Against the expansion in raw moments, in long double.
TEST(Statistics, OfManyRadii) {
  std::mt19937_64 random(4);
  std::gamma_distribution<double> gamma(3, 1);
  std::vector<double> radii(3000);
  for (double& r : radii) r = 1e-3 * (0.1 + gamma(random));
  long double raw[5] = {};
  for (const double r : radii)
    for (int k = 0; k < 5; ++k) raw[k] += std::pow((long double)r * 1000, k) / (long double)radii.size();
  const long double m = raw[1], n = (long double)radii.size();
  const long double second = raw[2] - m * m, third = raw[3] - 3 * m * raw[2] + 2 * m * m * m;
  const long double fourth = raw[4] - 4 * m * raw[3] + 6 * m * m * raw[2] - 3 * m * m * m * m;
  const long double s = std::sqrt(second * n / (n - 1));

  const FakeSummary got = statistics(particles(radii));
  const std::string r = "particle_radius";
  EXPECT_NEAR(at(got, r, "mean_m"), double(m / 1000), 1e-15);
  EXPECT_NEAR(at(got, r, "std_m"), double(s / 1000), 1e-15);
  EXPECT_NEAR(at(got, r, "skewness"), double(third / (s * s * s)), 1e-12);
  EXPECT_NEAR(at(got, r, "kurtosis"), double(fourth / (s * s * s * s) - 3), 1e-12);
  EXPECT_NEAR(at(got, "particle_radius_squared", "mean_m2"), double(raw[2] / 1e6L), 1e-18);
  std::nth_element(radii.begin(), radii.begin() + 1500, radii.end());
  const double upper = radii[1500], lower = *std::max_element(radii.begin(), radii.begin() + 1500);
  EXPECT_DOUBLE_EQ(at(got, r, "median_m"), 0.5 * (lower + upper));
}

TEST(Statistics, WhatIsNotDefinedIsNull) {
  const Json one = statistics(particles({0.25})).owned.at("particle_radius");
  EXPECT_EQ(one["mean_m"], 0.25);
  EXPECT_EQ(one["median_m"], 0.25);
  EXPECT_TRUE(one["std_m"].is_null());
  const Json equal = statistics(particles(std::vector<double>(7, 0.1))).owned.at("particle_radius");
  EXPECT_EQ(equal["mean_m"], 0.1);
  EXPECT_EQ(equal["std_m"], 0);
  EXPECT_TRUE(equal["skewness"].is_null());
  EXPECT_TRUE(equal["kurtosis"].is_null());
}

TEST(Statistics, HistogramEdges) {
  const FakeSummary got = statistics(particles({5, 1, 2, 2.5, 5, 3.75}), {{"bins", 4}});
  const Table& t = got.tables.at("histogram_particle_radius");
  ASSERT_EQ(t.columns.size(), 4u);
  EXPECT_EQ(t.columns[0].unit, "m");
  EXPECT_EQ(column(t, "from"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(column(t, "to"), (std::vector<double>{2, 3, 4, 5}));
  EXPECT_EQ(column(t, "count"), (std::vector<double>{1, 2, 1, 2})) << "2 lies above its edge, 5 in the last bin";
  EXPECT_EQ(column(t, "fraction"), (std::vector<double>{1 / 6.0, 2 / 6.0, 1 / 6.0, 2 / 6.0}));
  EXPECT_EQ(got.tables.at("histogram_particle_radius_squared").columns[1].unit, "m2");
}

TEST(Statistics, HistogramCountsEveryValueWhereItsRowSays) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(1e-4, 1e-3);
  std::vector<double> radii(2000);
  for (double& r : radii) r = uniform(random);
  const FakeSummary got = statistics(particles(radii));
  const Table& t = got.tables.at("histogram_particle_radius");
  const std::vector<double> from = column(t, "from"), to = column(t, "to"), count = column(t, "count");
  ASSERT_EQ(from.size(), 30u);
  for (std::size_t k = 0; k < 30; ++k) {
    const auto inside = [&](double r) { return r >= from[k] && (k == 29 ? r <= to[k] : r < to[k]); };
    EXPECT_EQ(count[k], double(std::count_if(radii.begin(), radii.end(), inside))) << k;
    EXPECT_EQ(from[k], k > 0 ? to[k - 1] : *std::min_element(radii.begin(), radii.end()));
  }
  EXPECT_EQ(std::accumulate(count.begin(), count.end(), 0.0), 2000);
}

TEST(Statistics, EqualRadiiShareOneBin) {
  const Table t = statistics(particles(std::vector<double>(9, 0.1))).tables.at("histogram_particle_radius");
  EXPECT_EQ(column(t, "from"), std::vector<double>{0.1});
  EXPECT_EQ(column(t, "to"), std::vector<double>{0.1});
  EXPECT_EQ(column(t, "count"), std::vector<double>{9});
  const Table nearly = statistics(particles({0.3, 0.1 + 0.2})).tables.at("histogram_particle_radius");
  EXPECT_EQ(column(nearly, "count"), std::vector<double>{2}) << "equal up to rounding";
}

}  // namespace
}  // namespace breccia::test
