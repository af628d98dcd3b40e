// SPDX-License-Identifier: BSD-3-Clause
// The springs in the contact plane are of second order in the time step: half the step, a quarter of the error.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

PackedParticles two(double distance = 2 * r, const Vec3& direction = Vec3::UnitX()) {
  PackedParticles p;
  p.position = {Vec3::Zero(), distance * direction};
  p.radius = {r, 1.4 * r};
  p.outline = SpecimenShape::Outline::box;
  return p;
}

struct LawUnderTest {
  std::string name;
  Json config;
};
std::vector<LawUnderTest> unbreakable() {
  Json net = nonlinear_tension({{"tensile_strain_limit", 1e3}});
  return {{"elastic_brittle", elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}})},
          {"nonlinear_tension", net},
          {"elasto_damage_plastic",
           {{"youngs_modulus", 10e9},
            {"poisson_ratio", 0.2},
            {"area_factor", 1.0},
            {"contact_damping", 0.0},
            {"tensile_strength", 1e15},
            {"shear_strength", 1e15},
            {"internal_friction", 0.3},
            {"friction", 0.4},
            {"softening_tension", 1.0},
            {"softening_shear", 1.0},
            {"failure", "uncoupled"}}}};
}

/// The history of a pair that is sheared and bent, then led round in `n` steps by a rotation and a stretch.
std::vector<double> history_after(const LawUnderTest& law, int n, bool rigid) {
  EngineSettings settings;
  settings.safety = 1e6;  // held in all directions: the step may be as long as it likes
  Bench b = make_bench(two(2.4 * r), law.config, 1e-9, settings, 3, law.name);
  b->prepare();
  const double dt = b->time_step(), arm = 2.4 * r;
  const auto lead = [&](const Vec3& v, const Vec3& w0, const Vec3& w1) {
    b->hold(0, dof::all, Vec3::Zero(), w0);
    b->hold(1, dof::all, v, w1);
    b->advance();
    b->forces();
  };
  for (const Index k : {0, 1}) b->hold(k, dof::all, Vec3::Zero(), Vec3::Zero());
  b->forces();
  lead(Vec3::Zero(), Vec3(0, 1e-3, 2e-3) / dt, Vec3(0, 3e-3, -5e-3) / dt);
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  const double angle = 1.2, stretch = rigid ? 0 : 0.02;
  const auto place = [&](double share) -> Vec3 {
    return arm * (1 + stretch * share) * (Eigen::AngleAxisd(angle * share, axis) * Vec3::UnitX());
  };
  // Not rigid: the particles also roll and twist against each other at a steady rate.
  const Vec3 spin = angle / n / dt * axis, other = rigid ? Vec3::Zero() : Vec3(Vec3(0.3, -0.2, 0.4) / n / dt);
  for (int k = 0; k < n; ++k)
    lead((place(double(k + 1) / n) - place(double(k) / n)) / dt, spin + other, spin - 0.5 * other);
  std::vector<double> columns;
  for (const auto& c : b->state().pairs.columns) columns.push_back(c[0]);
  return columns;
}

double difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t first) {
  double sum = 0;
  for (std::size_t c = first; c < first + 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

TEST(Order, ARigidRotationTurnsTheSpringsAndChangesThemWithTheSquareOfTheStepOnly) {
  for (const LawUnderTest& law : unbreakable()) {
    const std::vector<double> start = history_after(law, 1 << 14, true);  // the reference: as good as exact
    const auto error = [&](int n, std::size_t first) { return difference(history_after(law, n, true), start, first); };
    for (const std::size_t first : {0, 3}) {
      if (first == 3 && law.name != "nonlinear_tension") continue;  // it alone has a bending spring
      const double coarse = error(20, first), fine = error(40, first);
      EXPECT_GT(coarse, 3.7 * fine) << law.name << " column " << first;
      EXPECT_LT(coarse, 6 * fine) << law.name << " column " << first;
    }
  }
}

TEST(Order, SpringsUnderShearStretchRollAndTwistAreOfSecondOrder) {
  for (const LawUnderTest& law : unbreakable()) {
    const std::vector<double> start = history_after(law, 1 << 14, false);
    for (const std::size_t first : {0, 3}) {
      if (first == 3 && law.name != "nonlinear_tension") continue;
      const double coarse = difference(history_after(law, 40, false), start, first),
                   fine = difference(history_after(law, 80, false), start, first);
      EXPECT_GT(coarse, 3.5 * fine) << law.name << " column " << first;
    }
  }
}

TEST(Order, ASpringKeepsItsLengthInARotationOfManyTurns) {
  // What a first-order update gains or loses in each step adds up over a run.
  for (const LawUnderTest& law : unbreakable()) {
    EngineSettings settings;
    settings.safety = 1e6;
    Bench b = make_bench(two(2.4 * r), law.config, 1e-9, settings, 3, law.name);
    b->prepare();
    const double dt = b->time_step();
    for (const Index k : {0, 1}) b->hold(k, dof::all, Vec3::Zero(), Vec3(0, 2e-3, 1e-3) / dt);
    b->forces();
    const auto length = [&] {
      const auto& c = b->state().pairs.columns;
      return Vec3(c[0][0], c[1][0], c[2][0]).norm();
    };
    const double before = length();
    const Vec3 turn = Vec3(0.01, 0, 0) / dt;  // about the normal: spin alone
    for (const Index k : {0, 1}) b->hold(k, dof::all, Vec3::Zero(), turn);
    b->advance();
    for (int k = 0; k < 6000; ++k) {
      b->forces();
      b->advance();
    }
    EXPECT_NEAR(length(), before, 1e-5 * before) << law.name;
  }
}

/// Energy that is unaccounted for, over that at the start, of a free lattice of bonds that twists and shears, after the
/// same physical time.
double drift(const LawUnderTest& law, double safety, int dimension) {
  EngineSettings settings;
  settings.safety = safety;
  PackedParticles p = random_block(6, 6, dimension == 2 ? 1 : 4, r, 5);
  if (dimension == 2)
    for (Vec3& x : p.position) x.z() = 0;
  Bench b = make_bench(p, law.config, 0.15, settings, dimension, law.name);
  b->prepare();
  const Vec3 centre = 6 * r * Vec3(1, 1, 0);
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    const Vec3 x = b->state().particles.position()[k] - centre;
    const Vec3 turn = dimension == 2 ? Vec3(0, 0, 4e3) : Vec3(1e3, -2e3, 3e3);
    b->hold(k, dof::all, turn.cross(x) + 8e2 * Vec3(x.y(), 0, 0), turn);
    b->release(k, dof::all);
  }
  b->forces();
  b->mark_start_of_loading();
  const int n = int(std::lround(400 / safety));
  double sum = 0;
  int count = 0;
  for (int k = 0; k < n; ++k) {
    b->advance();
    b->forces();
    if (k > n / 2) {  // the mean: the error also swings
      sum += b->view().energy.error() / b->view().energy.initial;
      ++count;
    }
  }
  return sum / count;
}

TEST(Order, TheEnergyOfAFreeLatticeDriftsWithTheSquareOfTheStep) {
  for (const LawUnderTest& law : unbreakable())
    for (const int dimension : {2, 3}) {
      const double coarse = std::abs(drift(law, 0.4, dimension)), fine = std::abs(drift(law, 0.1, dimension));
      EXPECT_LT(coarse, 5e-3) << law.name << " " << dimension;
      EXPECT_LT(fine, coarse / 8) << law.name << " " << dimension << ": of first order it would be a quarter";
    }
}

}  // namespace
}  // namespace breccia::testing
