// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

FakeSimulation star(const std::vector<Vec3>& directions) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 0.5);
  for (const Vec3& n : directions) s.add_bond(0, s.add_particle(1.7 * n, 0.5));
  return s;
}

TEST(Fabric, OfKnownDirections) {
  const double c = std::sqrt(0.5);
  FakeSimulation s = star({Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(c, c, 0), Vec3(0, 0, 1)});
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_NEAR(p.curves.last("fabric_xx"), 1.5 / 4, 1e-15);
  EXPECT_NEAR(p.curves.last("fabric_yy"), 1.5 / 4, 1e-15);
  EXPECT_NEAR(p.curves.last("fabric_zz"), 1.0 / 4, 1e-15);

  s.break_bond(3, BondState::broken_tension);
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("fabric_zz"), 0);
  FakeSummary summary = p.finish(s.view());
  EXPECT_NEAR(summary.headlines["fabric_diagonal"][2].get<double>(), 0.25, 1e-15) << "of the bonds made";
  EXPECT_NEAR(summary.owned["initial_fabric"][0][1].get<double>(), 0.5 / 4, 1e-15);
  EXPECT_NEAR(summary.owned["final_fabric"][1][0].get<double>(), 0.5 / 3, 1e-15);
  EXPECT_EQ(summary.owned["final_count"], 3);
}

TEST(Fabric, ThreeAxesAreIsotropic) {
  FakeSimulation s = star({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  EXPECT_NEAR(p.finish(s.view()).owned["initial_anisotropy"].get<double>(), 0, 1e-14);
}

/// Directions drawn from E(t) = (1 + a cos 2t)/(2 pi): the anisotropy is a.
TEST(Fabric, AnisotropyInThePlaneIsTheAmplitude) {
  const double a = 0.4;
  std::vector<Vec3> directions;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> u(0, 1);
  while (directions.size() < 40000) {
    const double t = 2 * M_PI * u(random);
    if (u(random) * (1 + a) < 1 + a * std::cos(2 * t)) directions.push_back(Vec3(std::cos(t), std::sin(t), 0));
  }
  FakeSimulation s = star(directions);
  s.dimension = 2;
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  EXPECT_NEAR(p.finish(s.view()).owned["initial_anisotropy"].get<double>(), a, 0.03);  // some 4 standard errors
}

TEST(Fabric, OfTouchingPairs) {
  FakeSimulation s = star({Vec3::UnitX(), Vec3::UnitY()});
  const Index up = s.add_particle(Vec3(0, 0, 1), 0.5);
  s.add_pair(0, up, Vec3(0, 0, -2));
  s.set_force(0, Vec3(1, 0, 0));
  LoadedPostprocessor p("fabric", {{"of", "touching"}});
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_DOUBLE_EQ(p.curves.last("fabric_xx"), 0.5);
  EXPECT_DOUBLE_EQ(p.curves.last("fabric_yy"), 0);
  EXPECT_DOUBLE_EQ(p.curves.last("fabric_zz"), 0.5);
}

TEST(Fabric, ColumnsCanBeLeftOut) {
  FakeSimulation s = star({Vec3::UnitX()});
  LoadedPostprocessor p("fabric", {{"columns", false}});
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_TRUE(p.curves.columns().empty());
  s.break_bond(0, BondState::broken_shear);
  EXPECT_EQ(p.finish(s.view()).owned["final_fabric"][0][0], 0);
}

/// Two bonds along one axis and one along another, turned: phi = diag(2, 1, 0)/3 in the turned frame.
TEST(Fabric, DeviatorAndPrincipalValues) {
  const Mat3 turn = (Eigen::AngleAxisd(0.4, Vec3::UnitZ()) * Eigen::AngleAxisd(0.7, Vec3::UnitX())).toRotationMatrix();
  const Vec3 first = turn.col(0), second = turn.col(1);
  FakeSimulation s = star({first, -first, second});
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  const FakeSummary got = p.finish(s.view());
  for (const std::string when : {"initial", "final"}) {
    const Json values = got.owned.at(when + "_principal_values"), axes = got.owned.at(when + "_principal_directions");
    ASSERT_EQ(values.size(), 3u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(values[k].get<double>(), (2 - k) / 3.0, 1e-15);
      const Vec3 axis(axes[k][0], axes[k][1], axes[k][2]);
      EXPECT_NEAR(std::abs(axis.dot(turn.col(k))), 1, 1e-14) << k;
      EXPECT_EQ(axis.maxCoeff(), axis.cwiseAbs().maxCoeff()) << "largest component positive";
    }
    const Mat3 deviator = turn * Vec3(1 / 3.0, 0, -1 / 3.0).asDiagonal() * turn.transpose();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        EXPECT_NEAR(got.owned.at(when + "_deviator")[a][b].get<double>(), deviator(a, b), 1e-15);
    EXPECT_NEAR(got.owned.at(when + "_deviatoric_invariant").get<double>(), std::sqrt(1.5 * 2 / 9), 1e-15);
  }
}

TEST(Fabric, DeviatorInThePlane) {
  const double t = M_PI / 6;
  const Vec3 first(std::cos(t), std::sin(t), 0), second(-std::sin(t), std::cos(t), 0);
  FakeSimulation s = star({first, first, second});
  s.dimension = 2;
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  FakeSummary got = p.finish(s.view());
  ASSERT_EQ(got.owned["initial_principal_values"].size(), 2u);
  EXPECT_NEAR(got.owned["initial_principal_values"][0].get<double>(), 2 / 3.0, 1e-15);
  EXPECT_NEAR(got.owned["initial_principal_values"][1].get<double>(), 1 / 3.0, 1e-15);
  const Json axis = got.owned["initial_principal_directions"][0];
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(axis[a].get<double>(), first[a], 1e-15);
  EXPECT_NEAR(got.owned["initial_deviatoric_invariant"].get<double>(), 1 / 3.0, 1e-15) << "difference of the two";
  EXPECT_NEAR(got.owned["initial_deviator"][0][1].get<double>(), std::sin(2 * t) / 6, 1e-15);
  EXPECT_EQ(got.owned["initial_deviator"][2][2], 0);
}

TEST(Fabric, InvariantIsOneWhenAllDirectionsAreTheSame) {
  FakeSimulation s = star({Vec3(0, 0.6, 0.8), Vec3(0, -0.6, -0.8)});
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  FakeSummary got = p.finish(s.view());
  EXPECT_NEAR(got.owned["initial_deviatoric_invariant"].get<double>(), 1, 1e-15);
  EXPECT_NEAR(got.owned["initial_anisotropy"].get<double>(), 7.5, 1e-14);
}

TEST(Fabric, WithoutBondsThereIsNothingPrincipal) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 1);
  LoadedPostprocessor p("fabric");
  p.begin(s.view());
  FakeSummary got = p.finish(s.view());
  EXPECT_TRUE(got.owned["initial_principal_values"].is_null());
  EXPECT_TRUE(got.owned["final_deviator"].is_null());
}

}  // namespace
}  // namespace breccia::test
