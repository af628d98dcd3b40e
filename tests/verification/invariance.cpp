// SPDX-License-Identifier: BSD-3-Clause
// What must not matter: which end of a bond is named first, where the specimen stands, how it is turned.
#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

struct Moved {
  std::vector<Vec3> position;
  std::vector<double> spin;
  std::size_t broken = 0;
};

/// Crushes a free block by initial velocities, after moving the packing by x -> R x + t and listing it in another
/// order.
Moved crush(const Mat3& turn, const Vec3& shift, bool reverse, const Json& law = elastic_brittle(),
            const std::string& name = "elastic_brittle") {
  PackedParticles p = random_block(4, 4, 6, 1e-3, 3);
  const std::size_t n = p.position.size();
  std::vector<Vec3> velocity(n);
  for (std::size_t k = 0; k < n; ++k) {
    velocity[k] = turn * Vec3(0.1, 0.2, p.position[k].z() > 6e-3 ? -30.0 : 30.0);
    p.position[k] = turn * p.position[k] + shift;
  }
  if (reverse) {
    std::reverse(p.position.begin(), p.position.end());
    std::reverse(p.radius.begin(), p.radius.end());
    std::reverse(velocity.begin(), velocity.end());
  }
  Bench b = make_bench(p, law, 0.15, {}, 3, name);
  b->prepare();
  for (Index k = 0; k < n; ++k) {
    b->hold(k, dof::all, velocity[b->state().particles.id[k]], Vec3::Zero());
    b->release(k, dof::all);
  }
  b.steps(300);
  Moved m;
  m.position.resize(n);
  m.spin.resize(n);
  for (Index k = 0; k < n; ++k) {
    const Index id = b->state().particles.id[k], at = reverse ? Index(n - 1 - id) : id;
    m.position[at] = turn.transpose() * (b->state().particles.position()[k] - shift);
    m.spin[at] = b->state().particles.angular_velocity()[k].norm();
  }
  for (const BondState s : b->state().bonds.state) m.broken += is_broken(s);
  return m;
}

void expect_same(const Moved& a, const Moved& b, double tolerance) {
  EXPECT_EQ(a.broken, b.broken);
  EXPECT_GT(a.broken, 5u) << "the test must break something";
  for (std::size_t k = 0; k < a.position.size(); ++k) {
    ASSERT_LT((a.position[k] - b.position[k]).norm(), tolerance * 1e-3) << k;
    ASSERT_NEAR(a.spin[k], b.spin[k], 1e-5 * (1 + a.spin[k])) << k;
  }
}

TEST(Invariance, OrderOfParticlesAndEndsOfBonds) {
  expect_same(crush(Mat3::Identity(), Vec3::Zero(), false), crush(Mat3::Identity(), Vec3::Zero(), true), 1e-8);
}

TEST(Invariance, Translation) {
  expect_same(crush(Mat3::Identity(), Vec3::Zero(), false), crush(Mat3::Identity(), Vec3(0.3, -0.2, 0.7), false), 1e-8);
}

TEST(Invariance, Rotation) {
  const Mat3 turn =
      (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(-1.1, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  expect_same(crush(Mat3::Identity(), Vec3::Zero(), false), crush(turn, Vec3::Zero(), false), 1e-8);
}

TEST(Invariance, WithMoments) {
  const Mat3 turn = Eigen::AngleAxisd(-1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto crush_net = [](const Mat3& m, const Vec3& shift, bool reverse) {
    return crush(m, shift, reverse, nonlinear_tension(), "nonlinear_tension");
  };
  const Moved known = crush_net(Mat3::Identity(), Vec3::Zero(), false);
  expect_same(known, crush_net(Mat3::Identity(), Vec3::Zero(), true), 1e-8);
  expect_same(known, crush_net(turn, Vec3(0.3, -0.2, 0.7), false), 1e-8);
}

void spin_freely(const Json& law, const std::string& name) {
  EngineSettings settings;
  Bench b = make_bench(random_block(3, 3, 3, 1e-3, 5), law, 0.15, settings, 3, name);
  b->prepare();
  const Vec3 spin(300, -200, 500);  // quick: a quarter turn in some thousand steps
  Vec3 centre = Vec3::Zero();
  double mass = 0;
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    centre += b->state().particles.mass()[k] * b->state().particles.position()[k];
    mass += b->state().particles.mass()[k];
  }
  centre /= mass;
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    b->hold(k, dof::all, spin.cross(b->state().particles.position()[k] - centre), spin);
    b->release(k, dof::all);
  }
  b->mark_start_of_loading();
  const double turning = b->view().energy.initial;
  b.steps(int(1.5 / spin.norm() / b->time_step()));
  b->forces();
  const SimulationView view = b->view();
  // Springs hold the centrifugal load; a spring that did not follow the rotation would be stretched by millimetres.
  EXPECT_LT(view.energy.elastic, 0.01 * turning);
  EXPECT_NEAR(view.energy.kinetic, turning, 0.02 * turning);
}

TEST(Invariance, RigidRotationLoadsNoBond) {
  spin_freely(elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}}), "elastic_brittle");
  spin_freely(nonlinear_tension({{"tensile_strain_limit", 1e3}}), "nonlinear_tension");
}

}  // namespace
}  // namespace breccia::testing
