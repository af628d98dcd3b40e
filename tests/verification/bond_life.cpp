// SPDX-License-Identifier: BSD-3-Clause
// What a pair feels depends on what happened to it, not on what the pair list has kept of it.
#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

Json elasto_damage_plastic() {
  return {{"youngs_modulus", 10e9},
          {"poisson_ratio", 0.2},
          {"area_factor", 1.0},
          {"contact_damping", 0.0},
          {"tensile_strength", 5e6},
          {"shear_strength", 16e6},
          {"internal_friction", 0.3},
          {"friction", 0.4},
          {"softening_tension", 1.0},
          {"softening_shear", 1.0},
          {"failure", "uncoupled"},
          {"compressive_limits", {20e6, 45e6, 60e6}},
          {"compressive_slope_ratios", {3.0, 12.0, 22.0}}};
}

PackedParticles chain(int n, double distance) {
  PackedParticles p;
  for (int k = 0; k < n; ++k) {
    p.position.emplace_back(k * distance, 0, 0);
    p.radius.push_back(r);
  }
  p.outline = SpecimenShape::Outline::box;
  return p;
}

/// Two spheres on the x axis, led to one distance after the other.
class LedPair {
 public:
  LedPair(const std::string& law, const Json& config, double distance, bool bonded, double skin) {
    EngineSettings settings;
    settings.skin = skin;
    bench_ = make_bench(chain(2, distance), config, bonded ? 0.5 : -0.9, settings, 3, law);
    bench_->prepare();
    bench_->forces();
  }
  void to(double distance, int n = 4000) {
    for (const Index k : {0, 1}) bench_->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
    for (; n > 0; --n) {
      const double way = (distance - this->distance()) / n;
      bench_->hold(1, dof::all, Vec3(way, 0, 0) / bench_->time_step(), Vec3::Zero());
      bench_->advance();
      bench_->forces();
    }
  }
  /// Sideways by turning both the same way.
  void shear(double way, int n = 1000) {
    const Vec3 turn(0, 0, -way / n / distance() / bench_->time_step());
    for (const Index k : {0, 1}) bench_->hold(k, dof::all, Vec3::Zero(), turn);
    bench_.steps(n);
    bench_->forces();
  }
  double distance() const { return state().particles.position()[1].x() - state().particles.position()[0].x(); }
  Vec3 pull() const { return state().particles.force()[0]; }  ///< on the first [N]
  const State& state() const { return bench_.simulation->state(); }

 private:
  Bench bench_;
};

TEST(BondLife, ABrokenBondStaysBrokenWhenThePairListIsEmpty) {
  EngineSettings settings;
  settings.skin = 0.05;
  Bench b = make_bench(chain(3, 2 * r), elastic_brittle(), 1e-9, settings);
  b->prepare();
  for (const Index k : {0, 1, 2}) {
    const double x = b->state().particles.position()[k].x() - 2 * r;
    b->hold(k, dof::all, Vec3(500 * x, 0, 0), Vec3::Zero());
  }
  b->forces();
  b->mark_start_of_loading();
  const std::uint64_t first = b->rebuilds();
  for (int k = 0; k < 20; ++k) {
    b.steps(2500);
    b->forces();
    for (const Vec3& f : b->state().particles.force()) EXPECT_TRUE(k == 0 || f.norm() == 0);
  }
  EXPECT_EQ(b->state().pairs.size(), 0u);
  EXPECT_GT(b->rebuilds(), first + 3) << "lists must have been made from an empty one";
  for (const BondState s : b->state().bonds.state) EXPECT_EQ(s, BondState::broken_tension);
  const EnergyLedger e = b->view().energy;
  EXPECT_GT(e.fracture, 0.9 * e.boundary_work);
  EXPECT_LT(e.fracture, 1.1 * e.boundary_work);
}

struct History {
  const char* name;
  std::string law;
  Json config;
  double distance;
  bool bonded;
  double squeeze, shear;  ///< before they part [m]
  double back;            ///< distance at which they are measured [m]
};

std::vector<History> histories() {
  std::vector<History> all;
  const Json weak = {{"shear_strength", 1e5}};
  all.push_back({"gap", "elastic_brittle", elastic_brittle(), 2.3e-3, true, 0, 0, 2.25e-3});
  all.push_back({"net gap", "nonlinear_tension", nonlinear_tension(), 2.3e-3, true, 0, 0, 1.99e-3});
  for (const bool bonded : {true, false}) {
    all.push_back({"overlapping", "elastic_brittle", elastic_brittle(), 1.8e-3, bonded, 0, 0, 1.75e-3});
    all.push_back({"touching", "elastic_brittle", elastic_brittle(), 2e-3, bonded, 0, 0, 1.98e-3});
    all.push_back({"sheared", "elastic_brittle", elastic_brittle(weak), 1.8e-3, bonded, 5e-6, 2e-5, 1.75e-3});
    all.push_back({"net", "nonlinear_tension", nonlinear_tension(), 1.8e-3, bonded, 0, 0, 1.79e-3});
    all.push_back({"plastic", "elasto_damage_plastic", elasto_damage_plastic(), 2e-3, bonded, 2e-5, 0, 1.985e-3});
    all.push_back({"damaged", "elasto_damage_plastic", elasto_damage_plastic(), 2e-3, bonded, 0, 1e-5, 1.985e-3});
  }
  return all;
}

TEST(BondLife, WhatAReturningPairFeelsDoesNotDependOnTheSkin) {
  for (const History& h : histories()) {
    std::optional<double> expected;
    for (const double skin : {2.0, 0.3, 0.05})
      for (const double parting : {0.2e-3, 1.5e-3}) {
        LedPair pair(h.law, h.config, h.distance, h.bonded, skin);
        pair.to(h.distance - h.squeeze);
        pair.shear(h.shear);
        pair.to(std::max(h.distance, 2 * r) + parting);
        EXPECT_EQ(pair.pull().norm(), 0) << h.name;
        pair.to(h.back);
        const double pull = pair.pull().x();
        ASSERT_LT(pull, 0) << h.name << " bonded " << h.bonded;
        if (!expected) expected = pull;
        EXPECT_NEAR(pull, *expected, 1e-6 * std::abs(*expected))
            << h.name << " bonded " << h.bonded << " skin " << skin << " parted by " << parting;
        EXPECT_EQ(pair.pull().tail<2>().norm(), 0) << h.name << ": no shear is left of what was before";
        if (h.bonded) {
          const State& s = pair.state();
          ASSERT_EQ(s.pairs.size(), 1u);
          EXPECT_EQ(s.pairs.bond[0], 0u);
          EXPECT_EQ(s.bonds.pair[0], 0u);
          EXPECT_TRUE(is_broken(s.bonds.state[0]));
          EXPECT_EQ(s.pairs.state[0], s.bonds.state[0]);
        }
      }
  }
}

TEST(BondLife, ABrokenBondPushesFromItsInitialDistanceOn) {
  LedPair pair("elastic_brittle", elastic_brittle(), 1.8e-3, true, 0.3);
  pair.to(3.5e-3);
  pair.to(1.75e-3);
  EXPECT_NEAR(pair.pull().x(), -2 * 10e9 * r * 0.05e-3, 1e-3);  // K_n = 2 E_c R
}

TEST(TimeStep, APairThatCannotTouchBeforeTheNextLookDoesNotCount) {
  // A grid with gaps of half a radius: with bonds of each to one neighbour only.
  PackedParticles p = simple_cubic(6, 6, 6, 1.25 * r);
  for (double& radius : p.radius) radius = r;
  for (std::size_t k = 0; k < p.position.size(); k += 2) p.position[k + 1].x() = p.position[k].x() + 2 * r;
  std::optional<double> step;
  for (const double skin : {0.3, 0.5, 1.0, 2.0}) {
    EngineSettings settings;
    settings.skin = skin;
    Bench b = make_bench(p, elastic_brittle(), 1e-9, settings);
    b->prepare();
    if (!step) step = b->time_step();
    EXPECT_EQ(b->time_step(), *step) << skin;
  }
}

TEST(TimeStep, APairThatComesNearCountsBeforeItTouches) {
  // The third sphere flies at a bonded pair from the side, within one long list.
  PackedParticles p = chain(2, 2 * r);
  p.position.emplace_back(r, std::sqrt(3) * r + 0.75e-3, 0);
  p.radius.push_back(r);
  EngineSettings settings;
  settings.skin = 2;
  Bench b = make_bench(p, elastic_brittle({{"tensile_strength", 1e12}, {"shear_strength", 1e12}}), 1e-9, settings);
  b->prepare();
  const double alone = b->time_step();
  Index flying = 0;
  for (Index k = 0; k < 3; ++k)
    if (b->state().particles.id[k] == 2) flying = k;
  b->hold(flying, dof::all, Vec3(0, -0.5, 0), Vec3::Zero());
  const auto least_gap = [&] {
    double least = 1;
    for (Index k = 0; k < 3; ++k)
      if (k != flying)
        least = std::min(least,
                         (b->state().particles.position()[k] - b->state().particles.position()[flying]).norm() - 2 * r);
    return least;
  };
  ASSERT_GT(least_gap(), 0.5e-3);
  while (least_gap() > 1e-6) {
    b.steps(1);
    if (least_gap() > 0.35e-3) { ASSERT_EQ(b->time_step(), alone) << least_gap(); }
  }
  EXPECT_EQ(b->rebuilds(), 1u) << "all in one list";
  EXPECT_LT(b->time_step(), 0.9 * alone);
}

TEST(TimeStep, AWallCountsWhenItIsNearAndNotForTheSkin) {
  std::optional<double> step;
  for (const double skin : {0.3, 2.0}) {
    EngineSettings settings;
    settings.skin = skin;
    Bench b = make_bench(chain(2, 2 * r), elastic_brittle(), 1e-9, settings);
    b->add_wall({"stiff", Vec3(0, 0, -2e-3), Vec3::UnitZ(), 1e10, 0, 0});
    b->prepare();
    if (!step) step = b->time_step();
    EXPECT_EQ(b->time_step(), *step) << skin;
  }
}

TEST(StepLoopDeathTest, ForcesWithoutAStepBetweenThemAreTheProgrammersMistake) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  Bench b = make_bench(chain(2, 2 * r), elastic_brittle(), 1e-9);
  b->prepare();
  EXPECT_DEATH(b->advance(), "internal error");
  b->forces();
  EXPECT_DEATH(b->forces(), "internal error");
}

}  // namespace
}  // namespace breccia::testing
