// SPDX-License-Identifier: BSD-3-Clause
// What resolves a collision of loose particles: the energy that is lost or gained in a cloud of them that falls in on
// itself, without damping and friction, by the share of the critical time step.
#include <gtest/gtest.h>

#include <random>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

/// Energy unaccounted for at the end over that at the start, root mean square over `clouds` clouds of 125 particles.
double lost(double safety, int clouds) {
  double sum = 0;
  for (int cloud = 0; cloud < clouds; ++cloud) {
    PackedParticles p = random_block(5, 5, 5, 1.3 * r, unsigned(cloud + 1));
    for (double& radius : p.radius) radius /= 1.3;
    EngineSettings settings;
    settings.safety = safety;
    settings.skin = 0.6;
    Bench b = make_bench(p, elastic_brittle({{"tensile_strength", 1e6}, {"shear_strength", 1e6}, {"friction", 0.0}}),
                         1e-9, settings);
    b->prepare();
    std::mt19937_64 random(99 + unsigned(cloud));
    const auto uniform = [&] { return 2 * double(random() >> 11) * 0x1p-53 - 1; };
    const Vec3 centre = 6.5 * r * Vec3(1, 1, 1);
    for (Index k = 0; k < b->state().particles.size(); ++k) {
      const Vec3 v = -2e3 * (b->state().particles.position()[k] - centre) + 5 * Vec3(uniform(), uniform(), uniform());
      b->hold(k, dof::all, v, Vec3::Zero());
      b->release(k, dof::all);
    }
    b->forces();
    b->mark_start_of_loading();
    const double end = 1e-3;
    while (b->time() < end) {
      b->advance();
      b->forces();
    }
    const EnergyLedger e = b->view().energy;
    EXPECT_EQ(b->state().bonds.size(), 0u);
    EXPECT_LT(e.elastic, 0.05 * e.initial) << "the cloud has come apart again";
    sum += std::pow(e.error() / e.initial, 2);
  }
  return std::sqrt(sum / clouds);
}

TEST(Collisions, AreResolvedWithTheSquareOfTheStep) {
  const double coarse = lost(0.8, 8), half = lost(0.4, 8), fine = lost(0.1, 8);
  RecordProperty("share_lost_at_0.8", std::to_string(coarse));
  RecordProperty("share_lost_at_0.4", std::to_string(half));
  RecordProperty("share_lost_at_0.1", std::to_string(fine));
  std::printf("energy unaccounted for: %.4f at a safety of 0.8, %.4f at 0.4, %.4f at 0.1\n", coarse, half, fine);
  EXPECT_LT(half, coarse / 2);
  EXPECT_LT(fine, half / 4);
  EXPECT_LT(fine, 0.01);
}

}  // namespace
}  // namespace breccia::testing
