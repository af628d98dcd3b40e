// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

EnergyLedger ledger(double work, double unaccounted) {
  EnergyLedger e;
  e.initial = 0.5;
  e.boundary_work = work;
  e.elastic = 1;
  e.kinetic = 2;
  e.friction = 3;
  e.damping = 4;
  e.contact = 5;
  e.fracture = work + 0.5 - 15 - unaccounted;
  return e;
}

TEST(Energy, PassesThrough) {
  FakeSimulation s;
  LoadedPostprocessor p("energy");
  p.begin(s.view());
  p->start_of_loading(s.view());
  s.energy = ledger(100, 0.25);
  p.sample(s.view());
  const std::map<std::string, double> expected{
      {"energy_boundary_work", 100}, {"energy_elastic", 1}, {"energy_kinetic", 2},      {"energy_friction", 3},
      {"energy_damping", 4},         {"energy_contact", 5}, {"energy_fracture", 85.25}, {"energy_error", 0.25}};
  for (const auto& [name, value] : expected) EXPECT_EQ(p.curves.last(name), value) << name;
  FakeSummary summary = p.finish(s.view());
  EXPECT_DOUBLE_EQ(summary.headlines["energy_error"].get<double>(), 0.0025);
  EXPECT_EQ(summary.owned["fracture_J"], 85.25);
  EXPECT_EQ(summary.owned["initial_J"], 0.5);
}

TEST(Energy, ErrorIsRelativeToTheLargestWorkOfTheLoading) {
  FakeSimulation s;
  LoadedPostprocessor p("energy");
  p.begin(s.view());
  s.energy = ledger(5000, 400);  // before loading: another ledger
  p.sample(s.view());
  p->start_of_loading(s.view());
  for (const auto& [work, error] : {std::pair{50.0, 1.0}, {200.0, -4.0}, {150.0, -2.0}}) {
    s.energy = ledger(work, error);
    p.sample(s.view());
  }
  FakeSummary summary = p.finish(s.view());
  EXPECT_DOUBLE_EQ(summary.headlines["energy_error"].get<double>(), 2.0 / 200);
  EXPECT_DOUBLE_EQ(summary.owned["largest_relative_error"].get<double>(), 4.0 / 200);
  EXPECT_EQ(summary.owned["largest_boundary_work_J"], 200);
}

TEST(Energy, WithoutWorkThereIsNoRelativeError) {
  FakeSimulation s;
  LoadedPostprocessor p("energy");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_TRUE(p.finish(s.view()).headlines["energy_error"].is_null());
}

}  // namespace
}  // namespace breccia::test
