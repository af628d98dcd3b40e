// SPDX-License-Identifier: BSD-3-Clause
/// The roses of the post-processor `statistics`.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

FakeSummary statistics(const FakeSimulation& s, Json config = Json::object()) {
  LoadedPostprocessor p("statistics", std::move(config));
  p.begin(s.view());
  return p.finish(s.view());
}

FakeSimulation star(const std::vector<Vec3>& directions) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 0.5);
  for (const Vec3& n : directions) s.add_bond(0, s.add_particle(1.7 * n, 0.5));
  return s;
}

/// The sectors that are not empty, and their counts.
std::map<std::size_t, double> occupied(const Table& table) {
  std::map<std::size_t, double> counts;
  for (std::size_t k = 0; k < table.values[2].size(); ++k)
    if (table.values[2][k] > 0) counts[k] = table.values[2][k];
  return counts;
}
using Occupied = std::map<std::size_t, double>;

TEST(Rose, OfOneBondAlongX) {
  const FakeSummary got = statistics(star({Vec3(-1, 0, 0)}));
  const Table& xy = got.tables.at("rose_xy");
  ASSERT_EQ(xy.columns.size(), 4u);
  const char* names[] = {"angle_from", "angle_to", "count", "fraction"};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(xy.columns[c].name, names[c]);
  EXPECT_EQ(xy.columns[0].unit, "rad");
  ASSERT_EQ(xy.values[0].size(), 36u);
  EXPECT_EQ(xy.values[0][0], 0);
  EXPECT_DOUBLE_EQ(xy.values[0][9], M_PI / 2);
  EXPECT_DOUBLE_EQ(xy.values[1][35], 2 * M_PI);
  EXPECT_EQ(occupied(xy), (Occupied{{0, 1}, {18, 1}}));
  EXPECT_EQ(xy.values[3][18], 0.5);
  EXPECT_EQ(occupied(got.tables.at("rose_zx")), (Occupied{{9, 1}, {27, 1}})) << "x is the second axis of this plane";
  EXPECT_EQ(got.tables.count("rose_yz"), 0u) << "normal to it";
  EXPECT_EQ(got.owned.at("rose_yz").at("bonds"), 0);
  EXPECT_EQ(got.owned.at("rose_yz").at("bonds_left_out"), 1);
}

TEST(Rose, SenseOfAnglesInEachPlane) {
  const Vec3 n(std::cos(0.3), std::sin(0.3), 0);  // 17 degrees: the second sector of 36
  const FakeSimulation s = star({n, Vec3(n[2], n[0], n[1]), Vec3(n[1], n[2], n[0])});
  const FakeSummary got = statistics(s, {{"largest_tilt", 0.1}});
  for (const char* rose : {"rose_xy", "rose_yz", "rose_zx"})
    EXPECT_EQ(occupied(got.tables.at(rose)), (Occupied{{1, 1}, {19, 1}})) << rose;
}

TEST(Rose, OfACubicLattice) {
  FakeSimulation s;
  const auto number = [](int i, int j, int k) { return Index((i * 4 + j) * 3 + k); };  // 5 x 4 x 3 points
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k) s.add_particle(Vec3(i, j, k), 0.5);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k) {
        if (i > 0) s.add_bond(number(i, j, k), number(i - 1, j, k));
        if (j > 0) s.add_bond(number(i, j, k), number(i, j - 1, k));
        if (k > 0) s.add_bond(number(i, j, k), number(i, j, k - 1));
      }
  const double x = 4 * 4 * 3, y = 5 * 3 * 3, z = 5 * 4 * 2;
  const FakeSummary got = statistics(s, {{"sectors", 8}});
  EXPECT_EQ(occupied(got.tables.at("rose_xy")), (Occupied{{0, x}, {2, y}, {4, x}, {6, y}}));
  EXPECT_EQ(occupied(got.tables.at("rose_yz")), (Occupied{{0, y}, {2, z}, {4, y}, {6, z}}));
  EXPECT_EQ(occupied(got.tables.at("rose_zx")), (Occupied{{0, z}, {2, x}, {4, z}, {6, x}}));
  EXPECT_EQ(got.owned.at("rose_xy").at("bonds_left_out"), z);
  EXPECT_DOUBLE_EQ(got.tables.at("rose_xy").values[3][0], x / (2 * x + 2 * y));
}

TEST(Rose, BondsAsMadeAtTheStartOfLoading) {
  FakeSimulation s = star({Vec3::UnitX(), Vec3(0, -1, 0)});
  s.position[1] = Vec3(0, 3, 0);
  s.break_bond(1, BondState::broken_tension);
  EXPECT_EQ(occupied(statistics(s).tables.at("rose_xy")), (Occupied{{0, 1}, {9, 1}, {18, 1}, {27, 1}}));
}

std::vector<Vec3> isotropic(std::size_t count) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  std::vector<Vec3> directions;
  while (directions.size() < count) {
    const double x = normal(random), y = normal(random), z = normal(random);
    directions.push_back(Vec3(x, y, z).normalized());
  }
  return directions;
}

/// Each pair of opposite sectors gets a binomial number of bonds: 5 standard deviations are allowed.
TEST(Rose, OfIsotropicDirectionsIsUniform) {
  const std::size_t bonds = 20000;
  FakeSimulation s = star(isotropic(bonds));
  for (const char* name : {"rose_xy", "rose_yz", "rose_zx"}) {
    const Table t = statistics(s, {{"sectors", 24}}).tables.at(name);
    const double share = 1.0 / 12, deviation = std::sqrt(double(bonds) * share * (1 - share));
    double counts = 0, fractions = 0;
    for (std::size_t k = 0; k < 24; ++k) {
      EXPECT_NEAR(t.values[2][k], double(bonds) * share, 5 * deviation) << name << " " << k;
      EXPECT_EQ(t.values[2][k], t.values[2][(k + 12) % 24]) << "point symmetric";
      counts += t.values[2][k];
      fractions += t.values[3][k];
    }
    EXPECT_EQ(counts, 2.0 * double(bonds));
    EXPECT_NEAR(fractions, 1, 1e-14);
  }
}

TEST(Rose, DoesNotDependOnWhoIsFirst) {
  FakeSimulation s = star(isotropic(500));
  const FakeSummary one = statistics(s);
  std::swap(s.bond_i, s.bond_j);
  const FakeSummary other = statistics(s);
  for (const char* name : {"rose_xy", "rose_yz", "rose_zx"})
    EXPECT_EQ(one.tables.at(name).values, other.tables.at(name).values) << name;
}

/// Of isotropic directions a share sin(t) makes at most the angle t with a plane.
TEST(Rose, LargestTiltKeepsTheBondsNearThePlane) {
  const std::size_t bonds = 20000;
  const FakeSummary got = statistics(star(isotropic(bonds)), {{"largest_tilt", M_PI / 6}});
  const double kept = got.owned.at("rose_zx").at("bonds").get<double>();
  EXPECT_NEAR(kept, 0.5 * double(bonds), 5 * std::sqrt(0.25 * double(bonds)));
  EXPECT_EQ(got.owned.at("rose_zx").at("bonds_left_out").get<double>(), double(bonds) - kept);
}

TEST(Rose, TwoDimensionsHaveOnePlane) {
  FakeSimulation s = star({Vec3(1, 1, 0)});
  s.dimension = 2;
  const FakeSummary got = statistics(s, {{"sectors", 4}});
  EXPECT_EQ(occupied(got.tables.at("rose_xy")), (Occupied{{0, 1}, {2, 1}}));
  EXPECT_EQ(got.tables.count("rose_yz") + got.tables.count("rose_zx"), 0u);
  EXPECT_EQ(got.owned.count("rose_yz"), 0u);
}

TEST(Rose, OfAnAssemblyWithoutBonds) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 1);
  const FakeSummary got = statistics(s);
  EXPECT_TRUE(got.owned.at("pair_harmonic_mean_radius").is_null());
  EXPECT_EQ(got.owned.at("rose_xy").at("bonds"), 0);
  ASSERT_EQ(got.tables.size(), 2u) << "of the particles only";
  EXPECT_EQ(got.tables.count("histogram_particle_radius"), 1u);
}

TEST(Rose, OddNumberOfSectorsIsRefused) {
  const Issues issues = LoadedPostprocessor("statistics", {{"sectors", 9}}).issues;
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].path, "sectors");
  EXPECT_TRUE(LoadedPostprocessor("statistics", {{"sectors", 10}}).issues.empty());
}

}  // namespace
}  // namespace breccia::test
