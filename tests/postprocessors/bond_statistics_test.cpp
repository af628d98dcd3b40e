// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

/// Bonds along x with normal forces 1, -2 and 6 N (tension positive); the first also carries 3 N of shear.
FakeSimulation chain() {
  FakeSimulation s;
  for (int k = 0; k < 4; ++k) s.add_particle(Vec3(k, 0, 0), k == 3 ? 0.6 : 0.5);
  s.add_bond(0, 1, Vec3(1, 3, 0));
  s.add_bond(1, 2, Vec3(-2, 0, 0));
  s.add_bond(2, 3, Vec3(6, 0, 0));
  return s;
}

TEST(Bonds, LengthChangeField) {
  FakeSimulation s = chain();
  LoadedPostprocessor p("bond_statistics");
  p.begin(s.view());
  s.position[3].x() += 0.25;
  EXPECT_EQ(p.field(s.view(), "length_change"), (std::vector<double>{0, 0, 0.25}));
}

TEST(Bonds, Statistics) {
  FakeSimulation s = chain();
  s.add_pair(0, 3, Vec3(100, 0, 0));  // not a bond
  LoadedPostprocessor p("bond_statistics");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_DOUBLE_EQ(p.curves.last("bond_force_mean"), 3);
  EXPECT_DOUBLE_EQ(p.curves.last("bond_force_std"), std::sqrt((4.0 + 1 + 9) / 3));
  EXPECT_DOUBLE_EQ(p.curves.last("bond_force_min"), 1);
  EXPECT_DOUBLE_EQ(p.curves.last("bond_force_max"), 6);
  EXPECT_DOUBLE_EQ(p.curves.last("strong_network_share"), 1.0 / 3);
  EXPECT_EQ(p.curves.last("bonds_in_tension"), 2);
  EXPECT_EQ(p.curves.last("bonds_in_compression"), 1);

  const Json gap = p.finish(s.view()).owned["initial_gap_ratio"];
  EXPECT_DOUBLE_EQ(gap["max"].get<double>(), 0);
  EXPECT_DOUBLE_EQ(gap["min"].get<double>(), 1 / 1.1 - 1);
  EXPECT_DOUBLE_EQ(gap["mean"].get<double>(), (1 / 1.1 - 1) / 3);
}

TEST(Bonds, SummaryAtThePeakIsThatSample) {
  FakeSimulation s = chain();
  LoadedPostprocessor p("bond_statistics", {{"peak_of", "platen_stress"}});
  p.begin(s.view());
  p.sample(s.view());
  s.set_force(2, Vec3(9, 0, 0));
  p.sample(s.view());
  s.break_bond(2, BondState::broken_tension);
  p.sample(s.view());
  p.curves.add_column("platen_stress", {1, 5, 2});
  FakeSummary summary = p.finish(s.view());
  EXPECT_EQ(summary.owned["at_peak"]["max_normal_force_N"], 9);
  EXPECT_EQ(summary.owned["at_peak"]["bonds_in_tension"], 2);
  EXPECT_EQ(summary.owned["at_last"]["max_normal_force_N"], 2);
  EXPECT_EQ(summary.owned["at_last"]["bonds_in_tension"], 1);
}

TEST(Bonds, PeakNeedsACurve) {
  FakeSimulation s = chain();
  LoadedPostprocessor without("bond_statistics");
  without.begin(s.view());
  without.sample(s.view());
  EXPECT_EQ(without.finish(s.view()).owned.count("at_peak"), 0u);
  LoadedPostprocessor misnamed("bond_statistics", {{"peak_of", "no_such_curve"}});
  misnamed.begin(s.view());
  misnamed.sample(s.view());
  EXPECT_THROW(misnamed.finish(s.view()), UserError);
}

TEST(Bonds, OfAnAssemblyWithoutBonds) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 1);
  LoadedPostprocessor p("bond_statistics");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("bond_force_mean"), 0);
  EXPECT_TRUE(p.finish(s.view()).owned["initial_gap_ratio"].is_null());
}

}  // namespace
}  // namespace breccia::test
