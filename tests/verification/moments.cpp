// SPDX-License-Identifier: BSD-3-Clause
// Moments in bonds: natural frequencies, the critical time step, and rest where nothing is bonded, against equations.
#include <gtest/gtest.h>

#include <numbers>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3, length = 2 * r, kn = 1e6, density = 2650, pi = std::numbers::pi;  // [m], [m], [N], [kg/m3]

struct Stiffness {
  double shear_ratio, bending, torsion_ratio;  // [1], [N m/rad], [1]
};

/// Two equal particles that touch, on the x axis.
Bench pair(const Stiffness& k, int dimension, double safety, bool bonded = true) {
  PackedParticles p;
  p.position = {Vec3::Zero(), Vec3(length, 0, 0)};
  p.radius = {r, r};
  p.outline = SpecimenShape::Outline::box;
  EngineSettings settings;
  settings.safety = safety;
  Json law = nonlinear_tension({{"normal_stiffness", kn},
                                {"shear_stiffness_ratio", k.shear_ratio},
                                {"bending_stiffness", k.bending},
                                {"torsion_ratio", k.torsion_ratio},
                                {"tensile_strain_limit", 1e3}});
  law.erase("bond_modulus");
  law.erase("bending_ratio");
  Bench b = make_bench(p, law, bonded ? 1e-9 : -1e-3, settings, dimension, "nonlinear_tension");
  b->prepare();
  return b;
}

/// Starts them in opposite rotation.
void twirl(Bench& b, const Vec3& rate) {
  b->hold(0, dof::all, Vec3::Zero(), -rate);
  b->hold(1, dof::all, Vec3::Zero(), rate);
  for (const Index k : {0, 1}) b->release(k, dof::all);
  b->forces();
  b->mark_start_of_loading();
}

double mass(int dimension) { return density * pi * r * r * (dimension == 2 ? 1 : 4.0 / 3.0 * r); }
double inertia(int dimension) { return (dimension == 2 ? 0.5 : 0.4) * mass(dimension) * r * r; }

TEST(Moments, AFreePairSwingsWithTheFrequencyOfItsStiffness) {
  // Opposite rotations do not shear: J theta'' = -2 k theta for each of the two.
  const Stiffness k{0.5, 50, 0.3};
  const struct {
    int dimension;
    Vec3 axis;
    double stiffness;
    std::size_t column;
  } swings[] = {
      {2, Vec3::UnitZ(), 50, 5}, {3, Vec3::UnitZ(), 50, 5}, {3, Vec3::UnitY(), 50, 4}, {3, Vec3::UnitX(), 0.3 * 50, 6}};
  for (const auto& s : swings) {
    Bench b = pair(k, s.dimension, 0.05);
    twirl(b, s.axis);
    const double dt = b->time_step();
    std::vector<double> zeros;  // [s]
    double now = b->state().pairs.columns[s.column][0], most = 0;
    for (int step = 0; step < 20000 && zeros.size() < 11; ++step) {
      const double before = now;
      b->advance();
      b->forces();
      now = b->state().pairs.columns[s.column][0];
      if (before * now < 0) zeros.push_back(dt * (step + before / (before - now)));
      if (step % 7 == 0) most = std::max(most, std::abs(b->view().energy.error()) / b->view().energy.initial);
    }
    ASSERT_EQ(zeros.size(), 11u);
    const double frequency = 10 * pi / (zeros[10] - zeros[0]),
                 known = std::sqrt(2 * s.stiffness / inertia(s.dimension));
    // Central differences: sin(w dt/2) is half of the true w dt.
    EXPECT_NEAR(2 / dt * std::sin(0.5 * frequency * dt), known, 1e-5 * known)
        << s.dimension << "D, column " << s.column;
    EXPECT_LT(most, 2e-3) << "the energy swings with the square of the step and does not drift";
    EXPECT_LT(b->state().particles.velocity()[0].norm(), 1e-9 * r / dt);
    const Vec3 spin = b->state().particles.angular_velocity()[0] + b->state().particles.angular_velocity()[1];
    EXPECT_LT(spin.norm(), 1e-9) << "angular momentum";
  }
}

TEST(Moments, TheCriticalStepKnowsOfBendingAndTorsion) {
  for (const int dimension : {2, 3})
    for (const Stiffness& k :
         {Stiffness{0.5, 50, 1}, Stiffness{0.1, 2000, 0.1}, Stiffness{0.5, 0, 1}, Stiffness{0.1, 50, 90}}) {
      const double m = mass(dimension), inert = inertia(dimension), shear = k.shear_ratio * kn / length;
      // Shear couples translation and rotation: [shear, shear r; shear r, shear r^2 + bending] over [m, J].
      const double p = shear / m, q = (shear * r * r + k.bending) / inert, coupling = shear * r / std::sqrt(m * inert);
      double most = 0.5 * (p + q) + std::sqrt(0.25 * (p - q) * (p - q) + coupling * coupling);
      most = std::max(most, kn / length / m);
      if (dimension == 3) most = std::max(most, k.bending * k.torsion_ratio / inert);
      const double known = std::sqrt(2 / most);
      EXPECT_NEAR(pair(k, dimension, 1)->critical_step(), known, 1e-9 * known) << dimension << " " << k.bending;
    }
  const auto alone = [](double bending) { return pair({0.5, bending, 1}, 3, 1, false)->critical_step(); };
  EXPECT_EQ(alone(1e6), alone(0)) << "without a bond there is nothing to bend";
}

TEST(Moments, TheCriticalStepIsThatOfTheBendingModeWhereBendingIsStiffest) {
  const struct {
    int dimension;
    Stiffness k;
    Vec3 axis;
  } modes[] = {
      {2, {1e-9, 2000, 0}, Vec3::UnitZ()}, {3, {1e-9, 2000, 0}, Vec3::UnitY()}, {3, {1e-9, 100, 30}, Vec3::UnitX()}};
  for (const auto& mode : modes)
    for (const double safety : {0.99, 1.01}) {
      Bench b = pair(mode.k, mode.dimension, safety);
      twirl(b, 1e-3 * mode.axis);
      const auto fastest = [&] { return b->state().particles.angular_velocity()[0].norm(); };
      double most = 0;
      for (int step = 0; step < 300; ++step) {
        b->advance();
        b->forces();
        most = std::max(most, fastest());
      }
      if (safety < 1) EXPECT_LT(most, 1) << "bounded";
      else EXPECT_GT(most, 1e6) << "unstable: the step is not shorter than it need be";
    }
}

TEST(Moments, AppliedTorquesTurnAPairAndTheirWorkIsBooked) {
  // Opposite torques from rest: the spring goes to twice its rest under them, and back.
  const Stiffness k{0.5, 50, 0.3};
  const struct {
    int dimension;
    Vec3 axis;
    double stiffness;
    std::size_t column;
  } turns[] = {
      {2, Vec3::UnitZ(), 50, 5}, {3, Vec3::UnitZ(), 50, 5}, {3, Vec3::UnitY(), 50, 4}, {3, Vec3::UnitX(), 0.3 * 50, 6}};
  for (const auto& t : turns) {
    const double torque = 1e-4;
    Bench b = pair(k, t.dimension, 0.05);
    b->set_applied_force(0, Vec3::Zero(), -torque * t.axis, Mat3::Zero());
    b->set_applied_force(1, Vec3::Zero(), torque * t.axis, Mat3::Zero());
    b->forces();
    b->mark_start_of_loading();
    double most = 0, least = 0, work = 0, error = 0, fastest = 0;
    for (int step = 0; step < 3000; ++step) {
      b->advance();
      b->forces();
      const double spring = b->state().pairs.columns[t.column][0];
      most = std::max(most, spring);
      least = std::min(least, spring);
      fastest = std::max(fastest, 2 * b->state().particles.angular_velocity()[1].norm());
      if (step % 7) continue;
      const auto energy = b->view().energy;
      work = std::max(work, energy.boundary_work);
      error = std::max(error, std::abs(energy.error()));
    }
    const double known = 2 * torque / t.stiffness;
    EXPECT_NEAR(most, known, 1e-3 * known) << t.dimension << "D, column " << t.column;
    EXPECT_GT(least, -1e-3 * known);
    EXPECT_NEAR(work, torque * known, 2e-3 * torque * known);
    // The kinetic energy is that of half a step before: by so much it lags behind the work.
    EXPECT_LT(error, 0.51 * b->time_step() * torque * fastest);
    EXPECT_LT(b->state().particles.velocity()[0].norm(), 1e-9 * r / b->time_step());

    b->advance();
    b->set_applied_force(0, Vec3::Zero(), Vec3::Zero(), Mat3::Zero());
    b->set_applied_force(1, Vec3::Zero(), Vec3::Zero(), Mat3::Zero());
    b->forces();
    const double before = b->view().energy.boundary_work;
    for (int step = 0; step < 100; ++step) {
      b->advance();
      b->forces();
    }
    EXPECT_NEAR(b->view().energy.boundary_work, before, 1e-3 * work) << "what was taken away works no more";
  }
}

TEST(Moments, AFreeParticleSpinsUpUnderATorque) {
  const double torque = 1e-5;
  for (const int dimension : {2, 3}) {
    Bench b = pair({0.5, 50, 0.3}, dimension, 0.05, false);
    b->forces();
    b->mark_start_of_loading();
    b->set_applied_force(1, Vec3::Zero(), torque * Vec3(1, 1, 1), Mat3::Zero());
    b->set_applied_force(1, Vec3::Zero(), torque * Vec3(1, 1, 1), Mat3::Zero());  // stays, is not added
    b.steps(200);
    const Vec3 spin = b->state().particles.angular_velocity()[1];
    // The first step is a half one: leapfrog's velocities stand in the middle of steps.
    const double known = torque * 200 * b->time_step() / inertia(dimension);
    EXPECT_NEAR(spin.z(), known, 0.01 * known);
    EXPECT_NEAR(spin.x(), dimension == 2 ? 0 : known, 0.01 * known) << "in a plane nothing turns about x";
    EXPECT_EQ(b->state().particles.angular_velocity()[0], Vec3::Zero().eval());
  }
}

}  // namespace
}  // namespace breccia::testing
