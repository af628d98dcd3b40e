// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

FakeSimulation random_graph(int particles, double bond_chance, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  FakeSimulation s;
  for (int k = 0; k < particles; ++k) s.add_particle(Vec3(u(random), u(random), u(random)), 0.01 + 0.01 * u(random));
  for (Index i = 0; i < Index(particles); ++i)
    for (Index j = i + 1; j < Index(particles); ++j)
      if (u(random) < bond_chance) s.add_bond(i, j);
  return s;
}

/// Spreads labels along intact bonds until nothing changes: slow and plain.
std::vector<Index> labels(const FakeSimulation& s) {
  std::vector<Index> label = s.id;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t b = 0; b < s.bond_i.size(); ++b) {
      if (s.bond_state[b] != BondState::intact) continue;
      Index &x = label[s.bond_i[b]], &y = label[s.bond_j[b]];
      if (x != y) {
        x = y = std::min(x, y);
        changed = true;
      }
    }
  }
  return label;
}

TEST(Damage, FragmentsAgreeWithBruteForce) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    FakeSimulation s = random_graph(200, 0.03, seed);
    std::mt19937_64 random(seed + 100);
    LoadedPostprocessor p("damage");
    p.begin(s.view());
    for (int round = 0; round < 4; ++round) {
      const auto ids = p.field(s.view(), "fragment_id");
      const std::vector<Index> expected = labels(s);
      std::map<double, double> mass;
      std::map<double, int> members;
      for (std::size_t a = 0; a < ids.size(); ++a) {
        mass[ids[a]] += s.mass[a];
        ++members[ids[a]];
        for (std::size_t b = 0; b < a; ++b) ASSERT_EQ(ids[a] == ids[b], expected[a] == expected[b]);
      }
      double total = 0, before = mass.at(0);
      for (std::size_t k = 0; k < mass.size(); ++k) {
        ASSERT_LE(mass.at(double(k)), before) << "numbered from the heaviest";
        before = mass.at(double(k));
        total += before;
      }
      p.sample(s.view());
      EXPECT_NEAR(p.curves.last("largest_fragment_share"), mass.at(0) / total, 1e-14);
      const auto many = std::count_if(members.begin(), members.end(), [](const auto& m) { return m.second > 1; });
      EXPECT_EQ(p.curves.last("fragments"), double(many));
      for (std::size_t b = 0; b < s.bond_i.size(); ++b)
        if (s.bond_state[b] == BondState::intact && random() % 3 == 0) s.break_bond(b, BondState::broken_tension);
    }
    EXPECT_GT(p.curves.column("fragments").back(), 1);
  }
}

TEST(Damage, CountsByModeAndPerParticle) {
  FakeSimulation s;
  for (int k = 0; k < 6; ++k) s.add_particle(Vec3(k, 0, 0), 0.5);
  for (Index k = 0; k < 4; ++k) s.add_bond(k, k + 1);
  LoadedPostprocessor p("damage");
  p.begin(s.view());
  p->start_of_loading(s.view());
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("bonds_broken"), 0);
  EXPECT_EQ(p.curves.last("fragments"), 1);
  EXPECT_DOUBLE_EQ(p.curves.last("largest_fragment_share"), 5.0 / 6);

  s.break_bond(0, BondState::broken_tension);
  s.break_bond(1, BondState::broken_shear);
  s.break_bond(3, BondState::broken_combined);
  s.set_force(1, Vec3(-1, 0, 0));  // the second still touches
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("bonds_broken"), 3);
  EXPECT_EQ(p.curves.last("bonds_broken_tension"), 1);
  EXPECT_EQ(p.curves.last("bonds_broken_shear"), 1);
  EXPECT_EQ(p.curves.last("global_damage"), 0.75);
  EXPECT_EQ(p.curves.last("fragments"), 1);
  EXPECT_EQ(p.field(s.view(), "damage"), (std::vector<double>{1, 1, 0.5, 0.5, 1, 0}));
  EXPECT_EQ(p.field(s.view(), "coordination_number"), (std::vector<double>{0, 1, 2, 1, 0, 0}));
  // {2, 3} is heaviest; single particles follow in the order of the packing.
  EXPECT_EQ(p.field(s.view(), "fragment_id"), (std::vector<double>{1, 2, 0, 0, 3, 4}));

  FakeSummary summary = p.finish(s.view());
  EXPECT_EQ(summary.headlines["bonds_broken_tension"], 1);
  EXPECT_EQ(summary.headlines["bonds_broken_shear"], 1);
  EXPECT_EQ(summary.headlines["global_damage"], 0.75);
  EXPECT_EQ(summary.owned["bonds_broken_before_loading"], 0);
  EXPECT_EQ(summary.owned["single_particles"], 4);
}

TEST(Damage, NumbersEqualFragmentsByThePackingNotTheEngine) {
  FakeSimulation s;
  for (int k = 0; k < 3; ++k) s.add_particle(Vec3(k, 0, 0), 0.5);
  s.id = {2, 0, 1};
  LoadedPostprocessor p("damage");
  p.begin(s.view());
  EXPECT_EQ(p.field(s.view(), "fragment_id"), (std::vector<double>{2, 0, 1}));
}

TEST(Damage, OfAnAssemblyWithoutBonds) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 1);
  LoadedPostprocessor p("damage");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("global_damage"), 0);
  EXPECT_EQ(p.curves.last("fragments"), 0);
  EXPECT_EQ(p.curves.last("largest_fragment_share"), 1);
}

}  // namespace
}  // namespace breccia::test
