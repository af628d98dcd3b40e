// SPDX-License-Identifier: BSD-3-Clause
// Two spheres moved against each other: stiffness, strength and friction against the law's own equations.
#include <gtest/gtest.h>

#include <numbers>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r1 = 0.5e-3, r2 = 0.8e-3, modulus = 10e9, ratio = 3.7, strength = 40e6, friction = 0.5;

struct Model {
  const char* name;
  double radius, area, breadth;  ///< what stiffness and strength scale with; in two dimensions strength alone

  double stiffness(int dimension) const { return dimension == 2 ? modulus : 2 * modulus * radius; }  // thickness 1 m
  double limit(int dimension) const { return strength * (dimension == 2 ? 2 * breadth : 4 * area); }
};
const double mean = 0.5 * (r1 + r2), harmonic = 2 * r1 * r2 / (r1 + r2), bond_mean2 = mean * mean;
const Model models[] = {{"model_1", mean, mean* mean, mean},
                        {"model_2", harmonic, r1* r1, r1},
                        {"model_3a", mean, 0.5 * (r1 * r1 + r2 * r2), mean},
                        {"model_3b", mean, bond_mean2, mean},
                        {"model_3c", harmonic, r1* r1, r1}};

/// Particle 0 held still, particle 1 led with a velocity; `gap` is left between the surfaces (negative: overlap).
Bench pair_bench(const Json& law, double gap, double tolerance, const Vec3& velocity, int dimension = 3) {
  PackedParticles p;
  p.position = {Vec3(0, 0, 0), Vec3(r1 + r2 + gap, 0, 0)};
  p.radius = {r1, r2};
  p.outline = SpecimenShape::Outline::box;
  Bench b = make_bench(p, law, tolerance, {}, dimension);
  b->hold(0, dof::all, Vec3::Zero(), Vec3::Zero());
  b->hold(1, dof::all, velocity, Vec3::Zero());
  return b;
}

// Held particles set no time step: lead with small displacements per step instead.
void lead(Bench& b, const Vec3& displacement_per_step) {
  b->hold(1, dof::translation, displacement_per_step / b->time_step(), Vec3::Zero());
}

/// Time step of the same pair while nobody holds it.
void prepare_free(Bench& b) {
  b->release(0, dof::all);
  b->release(1, dof::all);
  b->prepare();
  b->hold(0, dof::all, Vec3::Zero(), Vec3::Zero());
  b->hold(1, dof::all, Vec3::Zero(), Vec3::Zero());
}

class EachModel : public ::testing::TestWithParam<Model> {};
INSTANTIATE_TEST_SUITE_P(TwoBody, EachModel, ::testing::ValuesIn(models),
                         [](const auto& model) { return std::string(model.param.name); });

void break_in_tension(const Model& m, int dimension) {
  Bench b = pair_bench(elastic_brittle({{"model", m.name}}), 0, 1e-9, Vec3::Zero(), dimension);
  prepare_free(b);
  const double kn = m.stiffness(dimension), limit = m.limit(dimension), step = limit / kn / 400;
  lead(b, Vec3(step, 0, 0));
  int broke_at = -1;
  for (int k = 0; k < 500 && broke_at < 0; ++k) {
    b->forces();
    const double pull = b->state().particles.force()[0].x();
    if (b->state().bonds.state[0] != BondState::intact) broke_at = k;
    else ASSERT_NEAR(pull, kn * k * step, 1e-6 * limit) << "step " << k;
    b->advance();
  }
  EXPECT_NEAR(broke_at, 400, 1);
  EXPECT_EQ(b->state().bonds.state[0], BondState::broken_tension);
  b->forces();
  EXPECT_EQ(b->state().particles.force()[0].norm(), 0) << "a broken bond pulls no more";
  EXPECT_NEAR(b->state().bonds.cracks.at(0).normal.x(), 1, 1e-12);
}

TEST_P(EachModel, TensionBreaksAtItsStrengthAndNotBefore) {
  break_in_tension(GetParam(), 3);
  break_in_tension(GetParam(), 2);
}

void break_in_shear(const Model& m, int dimension) {
  Bench b = pair_bench(elastic_brittle({{"model", m.name}}), 0, 1e-9, Vec3::Zero(), dimension);
  prepare_free(b);
  const double ks = m.stiffness(dimension) / ratio, limit = m.limit(dimension), step = limit / ks / 2000;
  lead(b, Vec3(0, step, 0));
  int broke_at = -1;
  for (int k = 0; k < 2200 && broke_at < 0; ++k) {
    b->forces();
    const auto& p = b->state().particles;
    if (b->state().bonds.state[0] != BondState::intact) broke_at = k;
    else {
      ASSERT_NEAR(p.force()[0].y(), ks * (k + 1) * step, 2e-4 * limit + ks * step) << "step " << k;
      // Force pair at one contact point: torques are lever arm times force, and the moments of all balance.
      const Vec3 all =
          p.torque()[0] + p.torque()[1] + p.position()[0].cross(p.force()[0]) + p.position()[1].cross(p.force()[1]);
      ASSERT_LT(all.norm(), 1e-12 * limit * r1 + 1e-15) << "step " << k;
    }
    b->advance();
  }
  EXPECT_NEAR(broke_at, 2000, 4);
  EXPECT_EQ(b->state().bonds.state[0], BondState::broken_shear);
}

TEST_P(EachModel, ShearBreaksAtItsStrengthAndTheTorquesBalance) {
  break_in_shear(GetParam(), 3);
  break_in_shear(GetParam(), 2);
}

TEST(TwoBody, BreakingInShearUnderPressureReleasesNoNormalForce) {
  for (const char* rest : {"initial_distance", "touching"}) {
    Bench b = pair_bench(elastic_brittle({{"broken_rest_length", rest}}), -0.05e-3, 0.0, Vec3::Zero());
    prepare_free(b);
    lead(b, Vec3(-2e-8, 0, 0));
    b.steps(100);
    lead(b, Vec3(0, 2e-9, 0));
    const auto push = [&] {
      const auto& p = b->state().particles;
      return -p.force()[0].dot((p.position()[1] - p.position()[0]).normalized());
    };
    double before = 0;
    for (int k = 0; k < 100000 && b->state().bonds.state[0] == BondState::intact; ++k) {
      before = push();
      b->forces();
      if (b->state().bonds.state[0] == BondState::intact) b->advance();
    }
    ASSERT_EQ(b->state().bonds.state[0], BondState::broken_shear);
    ASSERT_GT(before, 10);
    // The pair was overlapping when it was bonded, so both readings of the rest length are its first distance.
    EXPECT_NEAR(push(), before, 1e-3 * before) << rest;
  }
}

TEST(TwoBody, ABondAcrossAGapCarriesNoPressureAfterBreakageUntilTouchWhenSoAsked) {
  for (const bool keeps : {true, false}) {
    Bench b = pair_bench(
        elastic_brittle({{"broken_rest_length", keeps ? "initial_distance" : "touching"}, {"shear_strength", 1e3}}),
        0.1e-3, 0.2, Vec3::Zero());
    prepare_free(b);
    lead(b, Vec3(-1e-9, 2e-9, 0));
    b.steps(2000);
    ASSERT_EQ(b->state().bonds.state[0], BondState::broken_shear);
    b->forces();
    const double push = -b->state().particles.force()[0].x();
    if (keeps) EXPECT_GT(push, 0);
    else EXPECT_EQ(push, 0);
  }
}

TEST(TwoBody, SlidingFrictionIsCoulombAndItsWorkIsInTheLedger) {
  // Never bonded: tolerance below the overlap. Pressed, then led sideways along a circle's tangent.
  Bench b = pair_bench(elastic_brittle(), -0.02e-3, -0.5, Vec3::Zero());
  prepare_free(b);
  lead(b, Vec3(-1e-8, 0, 0));
  b.steps(200);
  b->forces();
  const double pressed = -b->state().particles.force()[0].x();
  ASSERT_NEAR(pressed, 2 * modulus * mean * 200e-8, 1e-3 * pressed);
  const double slip = 1e-9;
  const int n = 4000;
  b->mark_start_of_loading();
  lead(b, Vec3(0, slip, 0));
  b.steps(n);
  b->forces();
  const auto& f = b->state().particles.force()[0];
  const Vec3 normal = (b->state().particles.position()[1] - b->state().particles.position()[0]).normalized();
  const double fn = -f.dot(normal), fs = (f + fn * normal).norm();
  EXPECT_NEAR(fs, friction * fn, 1e-9 * fn);
  const SimulationView view = b->view();
  const double stick = fs / (2 * modulus * mean / ratio);  // the spring's share of the way
  EXPECT_NEAR(view.energy.friction, friction * pressed * (n * slip - stick), 0.02 * view.energy.friction);
  EXPECT_NEAR(view.energy.error(), 0, 2e-3 * view.energy.friction);
}

}  // namespace
}  // namespace breccia::testing
