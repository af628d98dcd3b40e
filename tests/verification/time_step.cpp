// SPDX-License-Identifier: BSD-3-Clause
// The critical time step with dashpots: what it is for a pair and for chains, and that it is where stability ends.
#include <gtest/gtest.h>

#include <numbers>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3, density = 2650, modulus = 20e9;

/// Bonds that never fail, with a dashpot xi.
Bench damped(const PackedParticles& packing, double xi, double tolerance, double step_share) {
  Bench b;
  b.law = make_law({{"youngs_modulus", modulus},
                    {"poisson_ratio", 0.5},
                    {"area_factor", 1.0},
                    {"contact_damping", xi},
                    {"tensile_strength", 1e18},
                    {"shear_strength", 1e18},
                    {"internal_friction", 0.0},
                    {"friction", 0.0},
                    {"softening_tension", 1.0},
                    {"softening_shear", 1.0},
                    {"failure", "uncoupled"}},
                   "elasto_damage_plastic");
  EngineSettings settings;
  settings.safety = step_share;
  b.simulation = std::make_unique<Simulation>(assemble(packing, {density}, 3, 1.0), *b.law, settings);
  b->bond({GapMeasure::relative, tolerance, std::nullopt});
  b->prepare();
  return b;
}

/// Mechanical energy after `steps` steps over that at the start, or the first ratio above 10.
double energy_left(Bench& b, int steps) {
  b->forces();
  b->mark_start_of_loading();
  const double initial = b->view().energy.initial;
  double left = 1;
  for (int k = 0; k < steps && left < 10; ++k) {
    b->advance();
    b->forces();
    const EnergyLedger e = b->view().energy;
    left = (e.elastic + e.kinetic) / initial;
  }
  return left;
}

void push(Bench& b, Index particle, const Vec3& velocity) {
  b->hold(particle, dof::all, velocity, Vec3::Zero());
  b->release(particle, dof::all);
}

/// K_n [N/m], C_n [N s/m] and mass [kg] of equal spheres that touch: the law's own equations.
struct Equal {
  double k = modulus * std::numbers::pi * r / 2, m = 4.0 / 3 * std::numbers::pi * r * r * r * density, c;
  explicit Equal(double xi) : c(xi * std::numbers::pi * std::sqrt(m / 2 * k)) {}
};

TEST(TimeStep, OfADampedPairIsExact) {
  for (const double xi : {0.3, 0.9}) {
    const Equal e(xi);
    const double exact = 2 * e.m / (e.c + std::sqrt(e.c * e.c + 2 * e.k * e.m));  // dt^2 K/2 + dt C = M
    for (const double share : {0.99, 1.01}) {
      Bench b = damped(simple_cubic(2, 1, 1, r), xi, 1e-9, share);
      ASSERT_NEAR(b->critical_step(), exact, 1e-9 * exact) << xi;
      push(b, 0, Vec3(1e-4, 0, 0));
      push(b, 1, Vec3(-1e-4, 0, 0));
      const double left = energy_left(b, 2000);
      if (share < 1) EXPECT_LT(left, 1e-3) << xi << ", below the bound: the dashpot stops it";
      else EXPECT_GT(left, 10) << xi << ", above the bound: it grows";
    }
  }
}

TEST(TimeStep, OfADampedChainIsSafeAndNearlyExact) {
  const int n = 40;
  for (const double xi : {0.3, 0.9}) {
    const Equal e(xi);
    const double bound = e.m / (e.c + std::sqrt(e.c * e.c + e.k * e.m));  // two neighbours: dt^2 K + 2 dt C = M
    for (const double share : {1.0, 1.01}) {
      Bench b = damped(simple_cubic(n, 1, 1, r), xi, 1e-9, share);
      ASSERT_NEAR(b->critical_step(), bound, 1e-9 * bound) << xi;
      for (Index k = 0; k < n; ++k) push(b, k, Vec3(b->state().particles.id[k] % 2 ? 1e-4 : -1e-4, 0, 0));
      const double left = energy_left(b, 2000);
      if (share <= 1) EXPECT_LT(left, 1e-2) << xi;
      else EXPECT_GT(left, 10) << xi;
    }
  }
}

TEST(TimeStep, OfADampedPackingIsSafeAndNotFarFromTheLimit) {
  for (const double xi : {0.3, 0.9})
    for (const double share : {1.0, 1.6}) {
      Bench b = damped(random_block(5, 5, 5, r, 3), xi, 0.2, share);
      std::mt19937_64 random(4);
      const auto speed = [&] { return 1e-4 * (double(random() >> 11) * 0x1p-52 - 1); };
      for (Index k = 0; k < 125; ++k) push(b, k, Vec3(speed(), speed(), speed()));
      const double left = energy_left(b, 2000);
      if (share <= 1) EXPECT_LT(left, 0.3) << xi;
      else EXPECT_GT(left, 10) << xi;
    }
}

TEST(TimeStep, OfAnUndampedPairIsThatOfItsFastestMode) {
  // nu = 0.5: K_s = K_n/3. Rolling in opposite senses strains the shear spring by 7/2 of what sliding does.
  const Equal e(0);
  const double exact = std::sqrt(2 * e.m / (3.5 / 3 * e.k));
  Bench b = damped(simple_cubic(2, 1, 1, r), 0, 1e-9, 1);
  EXPECT_NEAR(b->critical_step(), exact, 1e-9 * exact);
}

TEST(TimeStep, IsTheSameForAnyNumberOfThreads) {
  double one = 0;
  for (const int threads : {1, 2, 3, 8}) {
    EngineSettings settings;
    settings.threads = threads;
    Bench b = make_bench(random_block(8, 8, 8, r, 5), elastic_brittle(), 0.15, settings);
    b->prepare();
    if (threads == 1) one = b->critical_step();
    EXPECT_EQ(b->critical_step(), one) << threads;
  }
}

}  // namespace
}  // namespace breccia::testing
