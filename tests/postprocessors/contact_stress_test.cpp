// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A vertical pair under `load` and a horizontal one that is pulled with `pull`; the specimen has unit volume.
FakeSimulation cross(double load, double pull) {
  FakeSimulation s;
  s.specimen.volume = 1;
  const Index a = s.add_particle(Vec3::Zero(), 0.5), b = s.add_particle(Vec3(0, 0, 1), 0.4),
              c = s.add_particle(Vec3(2, 0, 0), 0.1);
  s.add_bond(a, b, Vec3(0, 0, -load));
  s.add_bond(a, c, Vec3(pull, 0, 0));
  return s;
}

double cell(const Table& t, const std::string& column, std::size_t row) {
  for (std::size_t c = 0; c < t.columns.size(); ++c)
    if (t.columns[c].name == column) return t.values[c].at(row);
  throw std::logic_error("no column " + column);
}

TEST(ContactStress, OfTwoContactsByHand) {
  FakeSimulation s = cross(3, 0.25);
  LoadedPostprocessor p("contact_stress", {{"bins", 2}, {"at", {1.0}}, {"limit", 3 / (pi * 0.16)}});
  p.begin(s.view());
  p.sample(s.view());
  const FakeSummary got = p.finish(s.view());
  const Table& t = got.tables.at("contact_stress_at_100_percent");
  // axial stress: 1 m x 3 N/1 m3
  const double axial = 3 / (pi * 0.16) / 3, lateral = 0.25 / (pi * 0.01) / 3;
  EXPECT_NEAR(cell(t, "ratio_all", 1), axial, 1e-14);
  EXPECT_NEAR(cell(t, "ratio_compressed", 1), axial, 1e-14);
  EXPECT_NEAR(cell(t, "ratio_yielded", 1), axial, 1e-14) << "at the limit counts";
  EXPECT_TRUE(std::isnan(cell(t, "ratio_tensile", 1)));
  EXPECT_NEAR(cell(t, "ratio_all", 0), -lateral, 1e-14);
  EXPECT_NEAR(cell(t, "ratio_tensile", 0), lateral, 1e-14);
  EXPECT_TRUE(std::isnan(cell(t, "ratio_compressed", 0)));
  EXPECT_EQ(cell(t, "yielded", 0), 0);
  EXPECT_DOUBLE_EQ(cell(t, "angle_to", 1), pi / 2);
  const Json all = got.owned.at("at_100_percent");
  EXPECT_DOUBLE_EQ(all["axial_stress_Pa"], 3);
  EXPECT_NEAR(all["ratio_all"].get<double>(), (axial - lateral) / 2, 1e-14);
  EXPECT_EQ(all["contacts"], 2);
  EXPECT_EQ(all["compressed"], 1);
}

TEST(ContactStress, AngleIsFromThePlaneAcrossTheAxis) {
  FakeSimulation s = cross(1, 0);
  const double angle = 0.3;
  const Index d = s.add_particle(Vec3(0, -std::cos(angle), -std::sin(angle)), 0.5);
  s.add_pair(0, d, Vec3(0, std::cos(angle), std::sin(angle)));  // pressed, never bonded
  s.add_pair(0, s.add_particle(Vec3(0, 3, 3), 0.5));            // a neighbour without a force does not count
  LoadedPostprocessor p("contact_stress", {{"bins", 90}, {"at", {1.0}}});
  p.begin(s.view());
  p.sample(s.view());
  const Table t = p.finish(s.view()).tables.at("contact_stress_at_100_percent");
  double all = 0;
  for (std::size_t k = 0; k < 90; ++k) {
    all += cell(t, "contacts", k);
    EXPECT_EQ(cell(t, "contacts", k), k == std::size_t(angle * 180 / pi) || k == 0 || k == 89 ? 1 : 0) << k;
  }
  EXPECT_EQ(all, 3);
}

TEST(ContactStress, SharesOfThePeakAreFoundAfterwardsOnTheFirstWayUp) {
  FakeSimulation s = cross(0, 0);
  LoadedPostprocessor p("contact_stress", {{"at", {0.1, 0.5, 1.0}}});
  p.begin(s.view());
  const auto load = [&](double f) {
    s.set_force(0, Vec3(0, 0, -f));
    s.set_force(1, Vec3(0.01 * f * f, 0, 0));
    p.sample(s.view());
  };
  for (double f = 0.1; f <= 8; f *= 1.01) load(f);
  for (double f = 8; f >= 1; f *= 0.99) load(f);  // unloading
  s.break_bond(1, BondState::broken_tension);     // would show if a later passage counted
  for (double f = 1; f <= 10; f *= 1.01) load(f);
  load(10);
  load(4);
  const FakeSummary got = p.finish(s.view());
  EXPECT_DOUBLE_EQ(got.owned.at("highest_axial_stress_Pa"), 10);
  for (const auto& [when, share] : {std::pair{"at_10_percent", 0.1}, {"at_50_percent", 0.5}, {"at_100_percent", 1.0}}) {
    const double stress = got.owned.at(when)["axial_stress_Pa"];
    EXPECT_NEAR(stress, share * 10, 0.0201 * share * 10) << when;
    const double area = pi * 0.01;
    EXPECT_NEAR(got.owned.at(when)["ratio_tensile"].get<double>(), 0.01 * stress / area, 1e-12) << when;
  }
  EXPECT_EQ(got.tables.size(), 3u);
}

TEST(ContactStress, InThePlaneTheAreaIsAStrip) {
  FakeSimulation s = cross(2, 0);
  s.dimension = 2;
  s.thickness = 0.1;
  s.specimen.axis = Vec3::UnitX();
  s.position[1] = Vec3(1, 0, 0);
  s.set_force(0, Vec3(-2, 0, 0));
  LoadedPostprocessor p("contact_stress", {{"area_factor", 0.5}});
  p.begin(s.view());
  p.sample(s.view());
  const FakeSummary got = p.finish(s.view());
  EXPECT_NEAR(got.owned.at("at_100_percent")["ratio_compressed"].get<double>(), 1 / (0.5 * 2 * 0.4 * 0.1), 1e-12);
}

/// The stress along the axis takes in what walls and applied forces do to the particles.
TEST(ContactStress, BoundaryForcesCount) {
  FakeSimulation s = cross(0, 0);
  s.wall_contacts.push_back({1, 0, Vec3(0, 0, 1.4), Vec3(0, 0, -5)});
  LoadedPostprocessor p("contact_stress");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_NEAR(p.finish(s.view()).owned.at("highest_axial_stress_Pa").get<double>(), 0.4 * 5, 1e-14);
}

TEST(ContactStress, WithoutCompressionThereIsNoTable) {
  FakeSimulation s = cross(-1, 0);
  LoadedPostprocessor p("contact_stress");
  p.begin(s.view());
  p.sample(s.view());
  const FakeSummary got = p.finish(s.view());
  EXPECT_TRUE(got.tables.empty());
  EXPECT_TRUE(got.owned.at("highest_axial_stress_Pa").is_null());
}

TEST(ContactStress, AShareGivenTwiceIsRefused) {
  EXPECT_EQ(LoadedPostprocessor("contact_stress", {{"at", {0.5, 0.5}}}).issues.size(), 1u);
}

}  // namespace
}  // namespace breccia::test
