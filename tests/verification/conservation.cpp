// SPDX-License-Identifier: BSD-3-Clause
// A free, undamped body keeps its momentum, angular momentum and energy; with damping and breakage the ledger closes.
#include <gtest/gtest.h>

#include "engine/particle_pass.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

Vec3 momentum(const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.particles.size(); ++k) sum += s.particles.mass[k] * s.particles.velocity[k];
  return sum;
}
Vec3 angular_momentum(const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.particles.size(); ++k)
    sum += s.particles.mass[k] * s.particles.position[k].cross(s.particles.velocity[k]) + s.particles.inertia[k] * s.particles.angular_velocity[k];
  return sum;
}

/// A block whose upper half starts toward the lower one, with some shear and spin.
Bench colliding_block(double speed, const EngineSettings& settings, const Json& law) {
  Bench b = make_bench(random_block(5, 5, 10, 1e-3, 7), law, 0.15, settings);
  b->prepare();
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    const bool up = b->state().particles.position[k].z() > 10e-3;
    const Vec3 v = speed * (up ? Vec3(0.3, 0.1, -1) : Vec3(-0.2, 0, 1));
    b->hold(k, dof::all, v, speed * 20 * Vec3(1, -2, 3));
    b->release(k, dof::all);
  }
  return b;
}

TEST(Conservation, MomentaAndEnergyOfAFreeElasticBody) {
  EngineSettings settings;
  settings.safety = 0.2;
  Bench b = colliding_block(0.05, settings, elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}}));
  b->forces();
  b->mark_start_of_loading();
  const Vec3 p0 = momentum(b->state()), l0 = angular_momentum(b->state());
  const double e0 = b->view().energy.initial;
  double scale = 0, spin = 0;
  for (std::size_t k = 0; k < b->state().particles.size(); ++k) {
    scale += b->state().particles.mass[k] * b->state().particles.velocity[k].norm();
    spin += b->state().particles.mass[k] * b->state().particles.velocity[k].norm() * 10e-3;
  }
  b.steps(3000);
  b->forces();
  EXPECT_LT((momentum(b->state()) - p0).norm(), 1e-11 * scale);
  EXPECT_LT((angular_momentum(b->state()) - l0).norm(), 1e-5 * spin);  // leapfrog: velocities lag by half a step
  const SimulationView view = b->view();
  EXPECT_GT(view.energy.elastic, 0.01 * e0) << "the test must store something";
  EXPECT_NEAR(view.energy.error(), 0, 2e-3 * e0);
}

TEST(Conservation, LedgerClosesWithDampingFrictionAndBreakage) {
  EngineSettings settings;
  settings.damping = {0.3, 0.3};
  Bench b = colliding_block(8, settings, elastic_brittle());
  b->forces();
  b->mark_start_of_loading();
  const double e0 = b->view().energy.initial;
  b.steps(4000);
  b->forces();
  const SimulationView view = b->view();
  std::size_t broken = 0;
  for (const BondState s : view.bonds.state) broken += is_broken(s);
  EXPECT_GT(broken, 50u) << "the test must break something";
  EXPECT_GT(view.energy.fracture, 0.001 * e0);
  EXPECT_GT(view.energy.friction, 0.001 * e0);
  EXPECT_GT(view.energy.damping, 0.1 * e0);
  EXPECT_NEAR(view.energy.error(), 0, 0.01 * e0);
}

TEST(Conservation, DampingActsOnTheNormOfTheResultant) {
  // One free particle, one force: a = F (1 - alpha) along the motion, F (1 + alpha) against it (Rojek 2012, Eq. 5).
  for (const double direction : {1.0, -1.0}) {
    State s = assemble(simple_cubic(1, 1, 1, 1e-3), {2650}, 3, 1);
    s.time_step = 1e-6;
    s.particles.velocity[0] = Vec3(0, 0, 2);
    s.particles.force[0] = Vec3(0, 0, direction * 3e-3);
    integrate(s, {0.4, 0.4}, false, 1);
    const double gain = (s.particles.velocity[0].z() - 2) * s.particles.mass[0] / s.time_step;
    EXPECT_NEAR(gain, direction * 3e-3 - 0.4 * 3e-3, 1e-12);
  }
}

}  // namespace
}  // namespace breccia::testing
