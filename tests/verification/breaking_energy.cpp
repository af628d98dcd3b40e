// SPDX-License-Identifier: BSD-3-Clause
// The energy of bonds that break within a few steps, and of particles led faster and faster, closes as leapfrog's own:
// what is left is rounding, or of the order of the law's curvature.
#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

PackedParticles chain(int n) {
  PackedParticles p;
  for (int k = 0; k < n; ++k) {
    p.position.emplace_back(2 * r * k, 0, 0);
    p.radius.push_back(r);
  }
  p.outline = SpecimenShape::Outline::box;
  return p;
}

/// Three in a row; the outer ones are led apart (and round, when they are sheared and bent) in the manner of a
/// protocol, which moves them before the forces of the step are known.
EnergyLedger pulled(const Json& config, const std::string& law, double safety, double pull, double across, double turn,
                    int steps, std::size_t* broken = nullptr) {
  EngineSettings settings;
  settings.safety = safety;
  Bench b = make_bench(chain(3), config, 1e-9, settings, 3, law);
  b->prepare();
  for (const Index k : {0, 2}) b->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
  b->forces();
  b->mark_start_of_loading();
  for (int k = 0; k < steps; ++k) {
    b->advance();
    const double share = std::min(1.0, (k + 1) / 3.0);
    for (const Index a : {0, 2}) {
      const double sign = b->state().particles.position()[a].x() > 2 * r ? 1 : -1;
      b->hold(a, dof::all, sign * share * Vec3(pull, across, 0), sign * share * Vec3(0, 0, turn));
    }
    b->forces();
  }
  if (broken) *broken = b->broken_bonds();
  return b->view().energy;
}

TEST(BreakingEnergy, ParticlesThatAreLedFasterAndFasterCloseToRounding) {
  for (const int steps : {1, 2, 3, 4, 7}) {
    const EnergyLedger e =
        pulled(elastic_brittle({{"tensile_strength", 1e15}}), "elastic_brittle", 0.8, 5, 0, 0, steps);
    EXPECT_GT(e.boundary_work, 0);
    EXPECT_NEAR(e.error(), 0, 1e-9 * e.boundary_work) << steps;
  }
}

TEST(BreakingEnergy, ABondThatBreaksInAFewStepsClosesToRounding) {
  for (const double safety : {0.8, 0.3}) {
    std::size_t broken = 0;
    const EnergyLedger e = pulled(elastic_brittle(), "elastic_brittle", safety, 5, 0, 0, 40, &broken);
    EXPECT_EQ(broken, 2u);
    EXPECT_GT(e.fracture, 0.5 * e.boundary_work);
    EXPECT_NEAR(e.error(), 0, 1e-6 * e.boundary_work) << safety;  // the particles turn a little in their plane
  }
}

TEST(BreakingEnergy, ABondThatBreaksWhileBentAndShearedLosesWhatTheWorkSays) {
  // The error of a law that is curved in tension goes with the square of the step, and more than half of it was the
  // step in which the bond broke.
  for (const auto& [law, config] : {std::pair<std::string, Json>{"elastic_brittle", elastic_brittle()},
                                    {"nonlinear_tension", nonlinear_tension()}}) {
    std::size_t broken = 0;
    const EnergyLedger e = pulled(config, law, 0.3, 3, 2, 1000, 60, &broken);
    EXPECT_GT(broken, 0u) << law;
    EXPECT_GT(e.fracture, 0) << law;
    EXPECT_NEAR(e.error(), 0, 0.01 * e.boundary_work) << law;
  }
}

/// What each crack says of its energy adds up to the ledger's, however many steps the bonds took to break.
TEST(BreakingEnergy, OfTheCracksAddsUpToTheLedger) {
  for (const auto& [law, config] : {std::pair<std::string, Json>{"elastic_brittle", elastic_brittle()},
                                    {"nonlinear_tension", nonlinear_tension()}}) {
    EngineSettings settings;
    settings.threads = 2;
    Bench b = make_bench(random_block(5, 5, 7, 1e-3, 5), config, 0.15, settings, 3, law);
    const auto& shape = b->state().specimen;
    const auto low = b->add_wall({"low", shape.base, Vec3::UnitZ(), 15e6, 5e6, 0.3});
    const auto high = b->add_wall({"high", shape.base + shape.height * Vec3::UnitZ(), -Vec3::UnitZ(), 15e6, 5e6, 0.3});
    b->prepare();
    b->set_wall_velocity(low, 4 * Vec3::UnitZ());
    b->set_wall_velocity(high, -4 * Vec3::UnitZ());
    b.steps(600);
    const SimulationView view = b->view();
    // A law books what the step in which a bond broke really did: of one that is pushed hard that is now and then a
    // little below zero.
    double sum = 0, below_zero = 0;
    std::size_t with_energy = 0;
    for (const Crack& c : view.bonds.cracks) {
      sum += c.energy;
      below_zero += std::min(c.energy, 0.0);
      with_energy += c.energy > 0;
    }
    EXPECT_GT(below_zero, -0.01 * sum) << law;
    ASSERT_GT(view.bonds.cracks.size(), 20u) << law;
    EXPECT_GT(with_energy, view.bonds.cracks.size() / 2) << law;
    EXPECT_NEAR(sum, view.energy.fracture, 1e-12 * view.energy.fracture) << law;
  }
}

}  // namespace
}  // namespace breccia::testing
