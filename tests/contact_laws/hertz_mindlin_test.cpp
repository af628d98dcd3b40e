// SPDX-License-Identifier: BSD-3-Clause
// Impacts of elastic spheres: Hertz's solution, restitution, and the cases of Chung, Ooi (2011), Granular Matter 13,
// 643-656 ("Benchmark tests for verifying discrete element modelling codes at particle impact level").
//
// A rigid wall is a held sphere, a hundred thousand times as large: R* = R and m* = m but for 1e-5; two bodies of twice
// the modulus have the E* and G* of one against a rigid one.
#include <gtest/gtest.h>

#include <numbers>

#include "several.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi;

Json grains(double youngs_modulus, double poisson_ratio, double friction, double restitution) {
  return {{"youngs_modulus", youngs_modulus},
          {"poisson_ratio", poisson_ratio},
          {"friction", friction},
          {"restitution", restitution},
          {"design_overlap", 0.01}};
}

/// `share`: of the critical time step, so small that an impact takes many steps.
Several pair(const PackedParticles& spheres, const Json& law, double density, double share) {
  EngineSettings settings;
  settings.safety = share;
  return Several(spheres, {{"hertz_mindlin", law}}, 0, settings, 3, 1, density);
}

Impact on_a_wall(const Json& law, double radius, double density, const Vec3& velocity, double share) {
  Json rigid = law;
  rigid["youngs_modulus"] = 2 * law["youngs_modulus"].get<double>();
  Several s = pair(two_spheres(radius, 1e5 * radius, 1e-4 * radius), rigid, density, share);
  s.lead(1, Vec3::Zero());
  return impact(s, velocity, Vec3::Zero());
}

TEST(HertzMindlin, ElasticImpactsAreHertzs) {
  struct Case {
    const char* name;
    double radius, youngs_modulus, poisson_ratio, density, speed;
    double force, overlap, time;  // published [N], [m], [s]
    bool wall;
  };
  for (const Case& c : {Case{"1: two spheres of glass", 0.01, 48e9, 0.2, 2800, 10, 10697, 274.1e-6, 40.34e-6, false},
                        Case{"2: on a rigid wall", 0.1, 70e9, 0.3, 2699, 0.2, 11370, 49.72e-6, 731.7e-6, true}}) {
    const Json law = grains(c.youngs_modulus, c.poisson_ratio, 0.35, 1);
    const Vec3 velocity(c.speed, 0, 0);
    const double share = 0.002;
    Several both = pair(two_spheres(c.radius, c.radius, 1e-4 * c.radius), law, c.density, share);
    const Impact i = c.wall ? on_a_wall(law, c.radius, c.density, velocity, share) : impact(both, velocity, -velocity);
    // As many digits as are published; the time is known to a step.
    EXPECT_NEAR(i.force / c.force, 1, 5e-4) << c.name;
    EXPECT_NEAR(i.overlap / c.overlap, 1, 5e-4) << c.name;
    EXPECT_NEAR(i.time / c.time, 1, 5e-4 + 2.0 / i.steps) << c.name;
    // Hertz: (15 m* v^2/(16 E* sqrt(R*)))^(2/5).
    const double half = c.wall ? 1 : 0.5, speed = c.speed / half,
                 mass = half * c.density * 4.0 / 3.0 * pi * std::pow(c.radius, 3),
                 modulus = half * c.youngs_modulus / (1 - c.poisson_ratio * c.poisson_ratio);
    EXPECT_NEAR(i.overlap / std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(half * c.radius)), 0.4), 1,
                1e-5 + 2.0 / (i.steps * i.steps))
        << c.name;
    EXPECT_NEAR(i.velocity[0].x() / -c.speed, 1, 1e-5) << c.name;
    EXPECT_NEAR(i.energy.error() / i.kinetic, 0, 1e-5) << c.name;
    EXPECT_NEAR(i.energy.contact, 0, 1e-20) << c.name;
  }
}

/// e is what was asked for, for any sizes and speed, and the spheres never pull. The dashpot takes the velocity of half
/// a step ago: e is off by the first power of the step.
TEST(HertzMindlin, RestitutionIsTheOneThatWasAskedFor) {
  for (const double e : {1.0, 0.98, 0.9, 0.7, 0.5, 0.3, 0.14, 0.13, 0.05})
    for (const double ratio : {1.0, 4.0})
      for (const double speed : {1.0, 10.0}) {
        const auto measured = [&](double share) {
          Several both = pair(two_spheres(1e-3, ratio * 1e-3, 1e-7), grains(70e9, 0.25, 0.3, e), 2500, share);
          const double other = speed * std::pow(ratio, -3);
          const Impact i = impact(both, Vec3(speed, 0, 0), Vec3(-other, 0, 0));
          EXPECT_GE(i.least_force, 0) << e;
          EXPECT_NEAR(i.energy.error() / i.kinetic, 0, 1e-3) << e;
          return (i.velocity[1] - i.velocity[0]).x() / (speed + other);
        };
        const double coarse = measured(0.02), fine = measured(0.01);
        EXPECT_NEAR(fine, e, 2e-3) << ratio << " " << speed;
        EXPECT_NEAR(2 * fine - coarse, e, 5e-4) << ratio << " " << speed;
      }
}

/// Case 4: oblique impacts. Slides throughout: the impulse along the plane is mu times that across it, m (1 + e) v_n,
/// and turns a sphere with the lever arm R. Published curves were read off (13 angles); the limits are those which
/// Kratos Multiphysics has in its own test against them.
TEST(HertzMindlin, ObliqueImpactsAreThePublishedOnes) {
  constexpr double radius = 2.5e-3, speed = 3.9, friction = 0.092, e = 0.98;
  struct Published {
    double angle, value;  // [deg], tangential restitution, spin [rad/s], angle of the rebound of the contact [deg]
  };
  const Published restitution[] = {{5.17, 0.948},  {10.16, 0.687}, {14.99, 0.624}, {20.06, 0.616}, {25.05, 0.634},
                                   {30.12, 0.684}, {35.03, 0.737}, {40.02, 0.781}, {50, 0.845},    {59.98, 0.893},
                                   {69.96, 0.932}, {80.02, 0.966}, {85.01, 0.983}},
                  spin[] = {{4.95, -19.3},   {10.08, -213.0}, {14.97, -377.8}, {19.94, -510.6}, {24.91, -599.4},
                            {29.96, -616.5}, {34.93, -582.3}, {39.98, -544.8}, {50, -457.0},    {60.02, -357.5},
                            {69.96, -246.2}, {80.06, -126.3}, {85.03, -63.1}},
                  rebound[] = {{4.90, 3.76},   {9.96, -1.56},  {14.93, -5.54}, {19.99, -7.54}, {24.96, -7.54},
                               {29.92, -3.55}, {34.96, 3.43},  {39.92, 11.57}, {49.83, 29.35}, {59.99, 47.79},
                               {69.74, 64.58}, {79.82, 78.70}, {84.78, 84.52}};
  const auto at = [&](double degrees) {
    const double angle = degrees * pi / 180;
    return on_a_wall(grains(380e9, 0.23, friction, e), radius, 4000, speed * Vec3(std::cos(angle), std::sin(angle), 0),
                     0.005);
  };
  double off[3] = {}, sum[3] = {};
  for (int k = 0; k < 13; ++k) {
    const auto count = [&](int which, double measured, double published) {
      off[which] += std::abs(measured - published);
      sum[which] += std::abs(published);
    };
    const double angle = restitution[k].angle * pi / 180;
    count(0, at(restitution[k].angle).velocity[0].y() / (speed * std::sin(angle)), restitution[k].value);
    count(1, at(spin[k].angle).spin[0].z(), spin[k].value);
    const Impact r = at(rebound[k].angle);
    // Of the point that touched: its velocity is the sphere's and the spin's.
    count(2, 180 / pi * std::atan((r.velocity[0].y() + r.spin[0].z() * radius) / -r.velocity[0].x()), rebound[k].value);
  }
  EXPECT_LT(off[0] / sum[0], 0.016);
  EXPECT_LT(off[1] / sum[1], 0.022);
  EXPECT_LT(off[2] / sum[2], 0.025);

  for (const double degrees : {50.0, 60.0, 80.0}) {
    const Impact i = at(degrees);
    const double angle = degrees * pi / 180, across = speed * std::cos(angle), along = speed * std::sin(angle);
    EXPECT_NEAR(-i.velocity[0].x() / across, e, 1e-3) << degrees;
    // The lever arm is shorter by half of the overlap, some 0.3 % of the radius.
    EXPECT_NEAR(i.velocity[0].y() / along, 1 - friction * (1 + e) / std::tan(angle), 1e-3) << degrees;
    EXPECT_NEAR(i.spin[0].z() * radius / (-2.5 * friction * (1 + e) * across), 1, 5e-3) << degrees;
    EXPECT_NEAR(i.energy.error() / i.kinetic, 0, 1e-5) << degrees;
    // What the friction takes: the mean of the sliding velocities before and after times the impulse, but for the
    // tangential spring, which has its share at the begin and at the end.
    const double mass = 4000 * 4.0 / 3.0 * pi * std::pow(radius, 3),
                 slides = along - 0.5 * 3.5 * friction * (1 + e) * across;
    EXPECT_NEAR(i.energy.friction / (mass * friction * (1 + e) * across * slides), 1, 0.02) << degrees;
  }
}

TEST(HertzMindlin, ThePackingsOverlapsAreFreeOfForce) {
  Several s(two_spheres(1e-3, 2e-3, -2e-5), {{"hertz_mindlin", grains(70e9, 0.25, 0.3, 0.9)}}, -0.5);
  s->forces();
  EXPECT_EQ(s->state().particles.force()[0], Vec3::Zero());
  for (const Index id : {0, 1}) s.lead(id, Vec3::Zero());
  s.lead(1, Vec3(-1e-6, 0, 0));
  s.step();
  s.lead(1, Vec3::Zero());
  s.step(2);  // at rest: no dashpot
  const double reduced = 1e-3 * 2 / 3, modulus = 70e9 / (2 * (1 - 0.25 * 0.25));
  EXPECT_NEAR(-s->state().particles.force()[s.of(0)].x() / (4.0 / 3.0 * modulus * std::sqrt(reduced) * 1e-9), 1, 1e-6);
  EXPECT_THROW(Several(two_spheres(1e-3, 1e-3), {{"hertz_mindlin", grains(70e9, 0.25, 0.3, 0.9)}}, 0, {}, 2),
               UserError);
}

}  // namespace
}  // namespace breccia::testing
