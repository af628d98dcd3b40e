// SPDX-License-Identifier: BSD-3-Clause
// The time step of the fastest mode: known frequencies, the end of stability, the same bits for any number of threads;
// and mass added for a longer one.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>
#include <numeric>

#include "engine/stiffness_operator.hpp"
#include "engine/time_step.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3, density = 2650, modulus = 20e9;
constexpr double m = 4.0 / 3 * std::numbers::pi * r * r * r * density;

Json plastic(double xi, double nu = 0.5) {
  return {{"youngs_modulus", modulus}, {"poisson_ratio", nu},    {"area_factor", 1.0},       {"contact_damping", xi},
          {"tensile_strength", 1e18},  {"shear_strength", 1e18}, {"internal_friction", 0.0}, {"friction", 0.0},
          {"softening_tension", 1.0},  {"softening_shear", 1.0}, {"failure", "uncoupled"}};
}

Json strong(const std::string& law) {
  if (law == "elasto_damage_plastic") return plastic(0.3);
  if (law == "nonlinear_tension") return nonlinear_tension({{"tensile_strain_limit", 1e9}});
  return elastic_brittle({{"tensile_strength", 1e18}, {"shear_strength", 1e18}});
}

Bench bonded(const PackedParticles& packing, const Json& law, const std::string& name, double tolerance,
             EngineSettings settings = {}) {
  settings.time_step = TimeStep::spectral;
  return make_bench(packing, law, tolerance, settings, 3, name);
}

/// The estimate is never above the limit, and hardly below.
void expect_step(double found, double exact, const std::string& of) {
  EXPECT_LE(found, exact * (1 + 1e-9)) << of;
  EXPECT_GE(found, exact * (1 - 2e-3)) << of;
}

TEST(SpectralStep, OfAChainThatOnlyStretchesIsKnown) {
  const double k = modulus * std::numbers::pi * r / 2;
  const int n = 40;
  for (const bool fixed : {false, true}) {
    Bench b = bonded(simple_cubic(n, 1, 1, r), plastic(0), "elasto_damage_plastic", 1e-9);
    for (Index a = 0; a < n; ++a) {
      const Index id = b->state().particles.id[a];
      const bool end = fixed && (id == 0 || id == n - 1);
      b->hold(a, end ? dof::all : std::uint8_t(dof::all & ~1), Vec3::Zero(), Vec3::Zero());
    }
    b->prepare();
    const double angle = fixed ? (n - 2) * std::numbers::pi / (2 * (n - 1)) : (n - 1) * std::numbers::pi / (2 * n);
    expect_step(b->critical_step(), 1 / (std::sqrt(k / m) * std::sin(angle)), fixed ? "fixed" : "free");
    EXPECT_GE(b->step_over_bound(), 1);
  }
}

TEST(SpectralStep, OfADampedChainIsKnown) {
  const double k = modulus * std::numbers::pi * r / 2;
  const int n = 30;
  for (const double xi : {0.3, 0.9}) {
    const double c = xi * std::numbers::pi * std::sqrt(m / 2 * k);
    Bench b = bonded(simple_cubic(n, 1, 1, r), plastic(xi), "elasto_damage_plastic", 1e-9);
    for (Index a = 0; a < n; ++a) b->hold(a, std::uint8_t(dof::all & ~1), Vec3::Zero(), Vec3::Zero());
    b->prepare();
    const double sine = std::sin((n - 1) * std::numbers::pi / (2 * n)), share = 4 * sine * sine;
    // dt^2/4 share k + dt/2 share c = m
    const double dt = 2 * m / (share * c / 2 + std::sqrt(share * share * c * c / 4 + share * k * m));
    expect_step(b->critical_step(), dt, "xi " + std::to_string(xi));
  }
}

TEST(SpectralStep, OfAPairIsThatOfItsRolling) {
  // nu = 0.5: K_s = K_n/3. Rolling in opposite senses strains the shear spring by 7/2 of what sliding does; the lever
  // arms of both ends are in it.
  const double k = modulus * std::numbers::pi * r / 2, exact = std::sqrt(2 * m / (3.5 / 3 * k));
  Bench b = bonded(simple_cubic(2, 1, 1, r), plastic(0), "elasto_damage_plastic", 1e-9);
  b->prepare();
  expect_step(b->critical_step(), exact, "pair");
}

TEST(SpectralStep, OfAParticleBetweenTwoWallsIsThatOfBothSprings) {
  PackedParticles two = simple_cubic(2, 1, 1, r);
  two.position[1].x() += 10 * r;
  Bench b = bonded(two, strong("elastic_brittle"), "elastic_brittle", 1e-9);
  for (const double y : {0.0, 2 * r}) {
    WallSpec wall;
    wall.name = y > 0 ? "top" : "bottom";
    wall.point = Vec3(0, y, 0);
    wall.normal = Vec3(0, y > 0 ? -1 : 1, 0);
    wall.normal_stiffness = 1e7;
    wall.shear_stiffness = 0;
    wall.friction = 0;
    b->add_wall(wall);
  }
  b->prepare();
  expect_step(b->critical_step(), 2 / std::sqrt(2e7 / m), "walls");
}

TEST(SpectralStep, OperatorAgreesWithTheMatrixOfOneEnd) {
  const ContactEnd end{Vec3(1, -2, 0.5).normalized(), 0.7, 0.4, {3, 2, 0.6, 0.3, 0}};
  Mat6 k = Mat6::Zero();
  add_contact(k, end);
  const Vec6 none = Vec6::Zero();
  for (int c = 0; c < 6; ++c) {
    Vec6 load = Vec6::Zero(), unit = Vec6::Unit(c);
    add_resistance(load.data(), end, unit.data(), none.data());
    add_moment_resistance(load.data(), end, unit.data(), none.data());
    EXPECT_LT((load - k.col(c)).norm(), 1e-14) << c;
  }
}

/// omega_max of the dense matrix, by Eigen's own solver.
double dense_step(Bench& b, const Incidence& in, ContactLaw& law) {
  State s = b->state();
  const StiffnessOperator system(s, law, in, 0.3 * r, 1);
  const int n = int(system.size());
  Eigen::MatrixXd matrix(6 * n, 6 * n);
  std::vector<Vec6> u(n + 1, Vec6::Zero());
  Vec6 k, c;
  for (int col = 0; col < 6 * n; ++col) {
    u[col / 6][col % 6] = std::sqrt(system.inverse_mass(col / 6, col % 6));
    for (int a = 0; a < n; ++a) {
      system.row(a, u.data(), k, c);
      for (int d = 0; d < 6; ++d) matrix(6 * a + d, col) = k[d] / std::sqrt(system.inverse_mass(a, d));
    }
    u[col / 6].setZero();
  }
  EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-9 * matrix.norm());
  return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[6 * n - 1]);
}

TEST(SpectralStep, OfLatticesAndPackingsIsThatOfTheWholeMatrix) {
  for (const char* name : {"elastic_brittle", "nonlinear_tension"})
    for (const bool lattice : {true, false}) {
      Bench b = bonded(lattice ? simple_cubic(4, 4, 4, r) : random_block(4, 4, 4, r, 7), strong(name), name, 0.2);
      b->prepare();
      const Incidence in = make_incidence(b->state(), 1);
      // The packing's mean radius is not r: what is counted is the bonds and what is near; all of it here is bonded.
      const double exact = dense_step(b, in, *b.law);
      expect_step(b->critical_step(), exact, std::string(name) + (lattice ? " lattice" : " packing"));
      EXPECT_GT(b->step_over_bound(), 1.02) << name;
    }
}

TEST(SpectralStep, IsTheSameForAnyNumberOfThreads) {
  for (const char* name : {"elastic_brittle", "elasto_damage_plastic"}) {
    double one = 0;
    for (const int threads : {1, 2, 3, 8}) {
      EngineSettings settings;
      settings.threads = threads;
      Bench b = bonded(random_block(9, 9, 9, r, 5), strong(name), name, 0.15, settings);
      b->prepare();
      if (threads == 1) one = b->critical_step();
      EXPECT_EQ(b->critical_step(), one) << threads << name;
    }
  }
}

/// Energy unaccounted for after `steps` steps, over what there was; stops at 10.
double energy_error(const std::string& law, double share, int steps) {
  EngineSettings settings;
  settings.safety = share;
  Bench b = bonded(random_block(5, 5, 5, r, 3), strong(law), law, 0.2, settings);
  b->prepare();
  std::mt19937_64 random(4);
  const auto speed = [&] { return 1e-4 * (double(random() >> 11) * 0x1p-52 - 1); };
  for (Index k = 0; k < 125; ++k) {
    b->hold(k, dof::all, Vec3(speed(), speed(), speed()), Vec3::Zero());
    b->release(k, dof::all);
  }
  b->forces();
  b->mark_start_of_loading();
  const double initial = b->view().energy.initial;
  double error = 0;
  try {
    for (int k = 0; k < steps && std::abs(error) < 10; ++k) {
      b->advance();
      b->forces();
      if (k < steps - 1 && k % 50) continue;
      const EnergyLedger e = b->view().energy;
      error = (e.elastic + e.kinetic + e.friction + e.damping + e.contact + e.fracture - initial - e.boundary_work) /
              initial;
    }
  } catch (const UserError&) {  // it ran away and said so
    return 10;
  }
  return std::abs(error);
}

TEST(SpectralStep, IsWhereStabilityEnds) {
  for (const char* law : {"elastic_brittle", "elasto_damage_plastic", "nonlinear_tension"})
    EXPECT_GE(energy_error(law, 1.02, 6000), 0.1) << law << ", above the limit: the energy check sees it";
}

TEST(SpectralStep, AtNineTenthsACompressionClosesItsEnergy) {
  for (const double alpha : {0.0, 0.7})
    for (const char* law : {"elastic_brittle", "elasto_damage_plastic", "nonlinear_tension"}) {
      EngineSettings settings;
      settings.safety = 0.9;
      settings.damping = {alpha, alpha};
      Bench b = bonded(random_block(5, 5, 5, r, 3), strong(law), law, 0.2, settings);
      double low = 1, high = -1;
      const Particles& p = b->state().particles;
      for (std::size_t a = 0; a < p.size(); ++a) {
        low = std::min(low, p.position()[a].z() - p.radius()[a]);
        high = std::max(high, p.position()[a].z() + p.radius()[a]);
      }
      for (const bool top : {false, true}) {
        WallSpec wall;
        wall.name = top ? "top" : "bottom";
        wall.point = Vec3(0, 0, top ? high : low);
        wall.normal = Vec3(0, 0, top ? -1 : 1);
        wall.normal_stiffness = 1.5e7;
        wall.shear_stiffness = 1.5e7;
        wall.friction = 0.3;
        b->add_wall(wall);
      }
      b->prepare();
      b->forces();
      b->mark_start_of_loading();
      for (int k = 0; k < 4000; ++k) {
        b->set_wall_velocity(1, Vec3(0, 0, -0.05 * std::min(1.0, k / 1000.0)));
        b->advance();
        b->forces();
      }
      const EnergyLedger e = b->view().energy;
      EXPECT_NEAR(e.elastic + e.kinetic + e.friction + e.damping + e.contact + e.fracture - e.initial, e.boundary_work,
                  1e-3 * e.boundary_work)
          << law << " alpha " << alpha;
    }
}

TEST(SpectralStep, NewNeighboursShortenIt) {
  // Two pairs fly at each other: the chain of four that they make is faster than each.
  PackedParticles four = simple_cubic(4, 1, 1, r);
  for (const int k : {2, 3}) four.position[k].x() += 3 * r;
  Bench b = bonded(four, strong("elastic_brittle"), "elastic_brittle", 1e-9);
  b->prepare();
  const double before = b->critical_step();
  for (Index a = 0; a < 4; ++a) {
    b->hold(a, dof::all, Vec3(b->state().particles.id[a] < 2 ? 10 : -10, 0, 0), Vec3::Zero());
    b->release(a, dof::all);
  }
  for (int k = 0; k < 20000 && b->critical_step() == before; ++k) b.steps(1);
  EXPECT_LT(b->critical_step(), before * 0.99);
  PackedParticles touching = simple_cubic(4, 1, 1, r);
  Bench whole = bonded(touching, strong("elastic_brittle"), "elastic_brittle", 1e-9);
  whole->prepare();
  EXPECT_NEAR(b->critical_step(), whole->critical_step(), 0.03 * whole->critical_step());
}

TEST(AddedMass, SpendsItsBudgetOnTheFewThatAskForTheShortestStep) {
  for (const TimeStep way : {TimeStep::bound, TimeStep::spectral}) {
    double total[2], step[2], bound = 0;
    for (const int with : {0, 1}) {
      EngineSettings settings;
      settings.added_mass = with ? 0.02 : 0;
      settings.time_step = way;
      Bench b = make_bench(random_block(6, 6, 6, r, 9), elastic_brittle(), 0.2, settings);
      b->prepare();
      const auto mass = b->state().particles.mass();
      total[with] = std::accumulate(mass.begin(), mass.end(), 0.0);
      step[with] = b->critical_step();
      if (!with) continue;
      bound = b->added_mass().step;
      EXPECT_NEAR(b->added_mass().share, 0.02, 1e-12);
      EXPECT_GT(b->added_mass().particles, 0u);
      EXPECT_LT(b->added_mass().particles, mass.size());
      for (std::size_t a = 0; a < mass.size(); ++a) {
        const double radius = b->state().particles.radius()[a];
        EXPECT_NEAR(b->state().particles.inertia()[a], 0.4 * mass[a] * radius * radius,
                    1e-12 * mass[a] * radius * radius);
      }
    }
    EXPECT_NEAR(total[1], 1.02 * total[0], 1e-12 * total[0]);
    EXPECT_GT(step[1], 1.05 * step[0]);
    if (way == TimeStep::bound) { EXPECT_NEAR(step[1], bound, 1e-8 * bound); }
  }
}

TEST(AddedMass, KeepsEnergyAndMomentum) {
  EngineSettings settings;
  settings.added_mass = 0.05;
  settings.safety = 0.3;
  Bench b = bonded(random_block(5, 5, 5, r, 3), strong("elastic_brittle"), "elastic_brittle", 0.2, settings);
  b->prepare();
  b->hold(0, dof::all, Vec3(1e-3, 2e-3, 0), Vec3::Zero());
  b->release(0, dof::all);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t a = 0; a < b->state().particles.size(); ++a)
      sum += b->state().particles.mass()[a] * b->state().particles.velocity()[a];
    return sum;
  };
  const Vec3 before = momentum();
  b->forces();
  b->mark_start_of_loading();
  const double initial = b->view().energy.initial;
  for (int k = 0; k < 500; ++k) {
    b->advance();
    b->forces();
  }
  const EnergyLedger e = b->view().energy;
  EXPECT_NEAR(e.elastic + e.kinetic, initial, 0.03 * initial);
  EXPECT_LT((momentum() - before).norm(), 1e-12 * before.norm());
}

}  // namespace
}  // namespace breccia::testing
