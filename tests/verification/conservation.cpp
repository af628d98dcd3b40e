// SPDX-License-Identifier: BSD-3-Clause
// A free, undamped body keeps its momentum, angular momentum and energy; with damping and breakage the ledger closes.
#include <gtest/gtest.h>

#include <limits>

#include "engine/particle_pass.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

Vec3 momentum(const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.particles.size(); ++k) sum += s.particles.mass()[k] * s.particles.velocity()[k];
  return sum;
}
Vec3 angular_momentum(const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.particles.size(); ++k)
    sum += s.particles.mass()[k] * s.particles.position()[k].cross(s.particles.velocity()[k]) +
           s.particles.inertia()[k] * s.particles.angular_velocity()[k];
  return sum;
}

/// A block whose upper half starts toward the lower one, with some shear and spin.
Bench colliding_block(double speed, const EngineSettings& settings, const Json& law, const std::string& name) {
  Bench b = make_bench(random_block(5, 5, 10, 1e-3, 7), law, 0.15, settings, 3, name);
  b->prepare();
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    const bool up = b->state().particles.position()[k].z() > 10e-3;
    const Vec3 v = speed * (up ? Vec3(0.3, 0.1, -1) : Vec3(-0.2, 0, 1));
    b->hold(k, dof::all, v, speed * 20 * Vec3(1, -2, 3));
    b->release(k, dof::all);
  }
  return b;
}

struct Errors {
  double energy, momentum, angular, initial, elastic, fracture, friction, damping;
  std::size_t broken;
};

/// The same physical time for every safety factor.
Errors after_collision(double speed, double safety, double damping, const Json& law,
                       const std::string& name = "elastic_brittle") {
  EngineSettings settings;
  settings.safety = safety;
  settings.damping = {damping, damping};
  Bench b = colliding_block(speed, settings, law, name);
  b->forces();
  b->mark_start_of_loading();
  const Vec3 p0 = momentum(b->state()), l0 = angular_momentum(b->state());
  double scale = 0;
  for (std::size_t k = 0; k < b->state().particles.size(); ++k)
    scale += b->state().particles.mass()[k] * b->state().particles.velocity()[k].norm();
  b.steps(int(1000 / safety));
  b->forces();
  const SimulationView v = b->view();
  std::size_t broken = 0;
  for (const BondState s : v.bonds.state) broken += is_broken(s);
  const double e0 = v.energy.initial;
  return {v.energy.error() / e0,
          (momentum(b->state()) - p0).norm() / scale,
          (angular_momentum(b->state()) - l0).norm() / (scale * 10e-3),
          e0,
          v.energy.elastic / e0,
          v.energy.fracture / e0,
          v.energy.friction / e0,
          v.energy.damping / e0,
          broken};
}

TEST(Conservation, MomentaAndEnergyOfAFreeElasticBody) {
  const Json unbreakable = elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}});
  const Errors coarse = after_collision(0.05, 0.4, 0, unbreakable), fine = after_collision(0.05, 0.1, 0, unbreakable);
  EXPECT_GT(fine.elastic, 0.01) << "the test must store something";
  EXPECT_LT(coarse.momentum, 1e-11);
  EXPECT_LT(fine.angular, 1e-5);
  // The spring that follows its plane is first order in the step: a quarter of the step, a quarter of the error.
  EXPECT_LT(std::abs(fine.energy), 1e-3);
  EXPECT_LT(std::abs(fine.energy), 0.4 * std::abs(coarse.energy));
}

TEST(Conservation, LedgerClosesWithDampingFrictionAndBreakage) {
  const Errors coarse = after_collision(40, 0.4, 0.3, elastic_brittle()),
               fine = after_collision(40, 0.05, 0.3, elastic_brittle());
  EXPECT_GT(fine.broken, 50u) << "the test must break something";
  EXPECT_GT(fine.fracture, 0.001);
  EXPECT_GT(fine.friction, 0.001);
  EXPECT_GT(fine.damping, 0.1);
  EXPECT_LT(std::abs(coarse.energy), 0.05);
  EXPECT_LT(std::abs(fine.energy), 0.005);
}

TEST(Conservation, AFreeBodyWhoseBondsBendAndTwist) {
  // Unbreakable, with the exponential's curvature where the strains are: b e_n0 = 8e-4.
  const Json unbreakable = nonlinear_tension({{"tensile_strain_limit", 1e3}, {"tension_shape", 8e-7}});
  const Errors coarse = after_collision(0.5, 0.4, 0, unbreakable, "nonlinear_tension"),
               fine = after_collision(0.5, 0.1, 0, unbreakable, "nonlinear_tension");
  EXPECT_EQ(fine.broken, 0u);
  EXPECT_GT(fine.elastic, 0.01) << "the test must store something";
  EXPECT_LT(coarse.momentum, 1e-11);
  EXPECT_LT(fine.angular, 1e-5);
  EXPECT_LT(std::abs(fine.energy), 1e-3);
  EXPECT_LT(std::abs(fine.energy), 0.4 * std::abs(coarse.energy));
}

TEST(Conservation, LedgerClosesWhenBondsThatBendBreak) {
  const Errors coarse = after_collision(40, 0.4, 0.3, nonlinear_tension(), "nonlinear_tension"),
               fine = after_collision(40, 0.05, 0.3, nonlinear_tension(), "nonlinear_tension");
  EXPECT_GT(fine.broken, 50u) << "the test must break something";
  EXPECT_GT(fine.fracture, 0.001);
  EXPECT_GT(fine.friction, 0.001);
  EXPECT_LT(std::abs(coarse.energy), 0.05);
  EXPECT_LT(std::abs(fine.energy), 0.005);
}

TEST(Conservation, DampingActsOnTheNormOfTheResultant) {
  // One free particle, one force: a = F (1 - alpha) along the motion, F (1 + alpha) against it (Rojek 2012, Eq. 5).
  for (const double direction : {1.0, -1.0}) {
    State s = assemble(simple_cubic(1, 1, 1, 1e-3), {2650}, 3, 1);
    s.time_step = 1e-6;
    s.particles.velocity()[0] = Vec3(0, 0, 2);
    s.particles.force()[0] = Vec3(0, 0, direction * 3e-3);
    BlockAccount account;
    integrate(s, {0.4, 0.4}, CellMotion{}, false, 1, {&account, 1});
    const double gain = (s.particles.velocity()[0].z() - 2) * s.particles.mass()[0] / s.time_step;
    EXPECT_NEAR(gain, direction * 3e-3 - 0.4 * 3e-3, 1e-12);
  }
}

/// Damping takes a free particle's velocity towards zero without end; what hits it then must move it.
TEST(Conservation, AParticleThatHasComeToRestCanBeHit) {
  for (const double speed : {1e-90, 1e-130, 1e-160, 1e-170, 5e-324}) {
    State s = assemble(simple_cubic(1, 1, 1, 1e-3), {2650}, 3, 1);
    s.time_step = 1e-6;
    s.particles.velocity()[0] = Vec3(speed, 0, -speed);
    s.particles.angular_velocity()[0] = Vec3(0, speed, 0);
    s.particles.force()[0] = Vec3(0, 2e3, 0);
    s.particles.torque()[0] = Vec3(0, 0, 3);
    BlockAccount account;
    integrate(s, {0.7, 0.7}, CellMotion{}, false, 1, {&account, 1});
    EXPECT_NEAR(s.particles.velocity()[0].y() * s.particles.mass()[0] / s.time_step, 2e3, 1e-9) << speed;
    EXPECT_NEAR(s.particles.angular_velocity()[0].z() * s.particles.inertia()[0] / s.time_step, 3, 1e-9) << speed;
    EXPECT_TRUE(s.particles.velocity()[0].allFinite() && s.particles.angular_velocity()[0].allFinite()) << speed;
  }
}

TEST(Conservation, AVelocityThatIsNotANumberEndsTheRun) {
  const PackedParticles packing = random_block(10, 10, 6, 1e-3, 7);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const Index which : {Index(0), Index(1), Index(300), Index(599)}) {
      Bench b = make_bench(packing, elastic_brittle(), 0.15);
      b->prepare();
      b->forces();
      b->hold(which, dof::x, Vec3(bad, 0, 0), Vec3::Zero());
      EXPECT_THROW(b->advance(), UserError) << bad << " of particle " << which;
    }
}

}  // namespace
}  // namespace breccia::testing
