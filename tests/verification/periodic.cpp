// SPDX-License-Identifier: BSD-3-Clause
// A space that repeats itself: exact constants of a crystal, no trace of where the cell is cut, momentum and energy
// kept.
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

/// Face-centred cubic, n cells along each edge, nearest neighbours tangent.
PackedParticles fcc(int n, double r) {
  const double edge = 2 * std::sqrt(2.0) * r;
  PackedParticles p;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const Vec3& site : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}) {
          p.position.push_back(edge * (Vec3(i, j, k) + site));
          p.radius.push_back(r);
        }
  p.period = Vec3::Constant(n * edge);
  return p;
}

/// A block that fits its own other side.
PackedParticles periodic_block(int nx, int ny, int nz, double r, unsigned seed) {
  PackedParticles p = random_block(nx, ny, nz, r, seed);
  p.period = 2 * r * Vec3(nx, ny, nz);
  return p;
}

/// The same space, cut elsewhere.
PackedParticles cut_at(PackedParticles p, const Vec3& shift) {
  for (Vec3& x : p.position) {
    x += shift;
    for (int k = 0; k < 3; ++k)
      if (p.period[k] > 0) x[k] -= p.period[k] * std::floor(x[k] / p.period[k]);
  }
  return p;
}

void strain(Bench& b, const Mat3& rate, int steps) {
  for (int k = 0; k < steps; ++k) {
    b->set_cell_velocity(rate * b->cell().vectors());
    b.steps(1);
  }
}

Vec3 momentum(const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < s.particles.size(); ++k) sum += s.particles.mass()[k] * s.particles.velocity()[k];
  return sum;
}

/// Sum over the bonds of d^2 times what a unit strain makes of them, over the volume.
double sum_of_bonds(const State& s, const std::function<double(const Vec3&)>& of) {
  double sum = 0;
  for (std::size_t k = 0; k < s.bonds.size(); ++k) {
    const Vec3 b = s.branch(s.particles.position()[s.bonds.i[k]], s.particles.position()[s.bonds.j[k]]);
    sum += b.squaredNorm() * of(b.normalized());
  }
  return sum / s.cell_volume();
}

/// Born's constants of a lattice of normal and shear springs, without internal motion.
TEST(Periodic, AFaceCentredCrystalHasItsExactElasticConstants) {
  const double ratio = 3.7, small = 1e-7;
  struct Case {
    const char* name;
    Mat3 strain;
    int row, column;
    std::function<double(const Vec3&, double, double)> exact;  // of n, kn, ks
  };
  Mat3 stretch = Mat3::Zero(), shear = Mat3::Zero();
  stretch(2, 2) = 1;
  shear(0, 1) = shear(1, 0) = 0.5;
  const auto square = [](double x) { return x * x; };
  const Case tests[] = {
      {"c11", stretch, 2, 2,
       [&](const Vec3& n, double kn, double ks) { return (kn - ks) * square(n.z() * n.z()) + ks * square(n.z()); }},
      {"c12", stretch, 0, 0, [&](const Vec3& n, double kn, double ks) { return (kn - ks) * square(n.x() * n.z()); }},
      {"c44", shear, 0, 1, [&](const Vec3& n, double kn, double ks) {
         return (kn - ks) * square(n.x() * n.y()) + 0.25 * ks * (square(n.x()) + square(n.y()));
       }}};
  for (const Case& t : tests) {
    Bench b = make_bench(fcc(3, 1e-3), elastic_brittle({{"stiffness_ratio", ratio}}), 1e-6);
    b->prepare();
    ASSERT_EQ(b->state().bonds.size(), 6 * b->state().particles.size()) << "twelve neighbours each";
    const double kn = b->bond_stiffness().mean_normal, ks = kn / ratio;
    const double rate = small / (50 * b->time_step());
    const Mat3 before = b->cell().vectors();
    strain(b, rate * t.strain, 50);
    b->set_cell_velocity(Mat3::Zero());
    b.steps(1);
    b->forces();
    const Mat3 growth = b->cell().vectors() * before.inverse() - Mat3::Identity();
    const double reached = growth.cwiseProduct(t.strain).sum() / t.strain.squaredNorm();
    ASSERT_NEAR(reached, small, 0.05 * small);
    const double exact = sum_of_bonds(b->state(), [&](const Vec3& n) { return t.exact(n, kn, ks); });
    EXPECT_NEAR(b->cell_stress()(t.row, t.column) / reached, exact, 2e-6 * exact) << t.name;
  }
}

TEST(Periodic, AChainAcrossTheBoundaryKnowsNoBoundary) {
  const int n = 8;
  const double r = 1e-3;
  PackedParticles ring = simple_cubic(n, 1, 1, r);
  ring.period = Vec3(2 * r * n, 0, 0);
  Bench b = make_bench(cut_at(ring, Vec3(0.7e-3, 0, 0)), elastic_brittle(), 1e-6);
  b->prepare();
  const State& s = b->state();
  ASSERT_EQ(s.bonds.size(), std::size_t(n));
  Mat3 rate = Mat3::Zero();
  rate(0, 0) = 1e-3 / (200 * b->time_step());
  for (int k = 0; k < 100; ++k) {
    strain(b, rate, 2);
    b->forces();
    for (std::size_t q = 0; q < s.pairs.size(); ++q) {
      EXPECT_EQ(s.pairs.state[q], BondState::intact);
      const PairForce &f = s.pairs.force[q], &first = s.pairs.force[0];
      EXPECT_NEAR(std::abs(f.fx), std::abs(first.fx), 1e-9 * std::abs(first.fx)) << "pair " << q << ", step " << s.step;
    }
    b->advance();
  }
  strain(b, 20 * rate, 200);
  for (const BondState state : s.bonds.state) EXPECT_EQ(state, BondState::broken_tension);
  ASSERT_EQ(s.bonds.cracks.size(), s.bonds.size());
  for (const Crack& c : s.bonds.cracks) EXPECT_EQ(c.time, s.bonds.cracks[0].time) << "all at once";
}

/// Random block, sheared and shortened until bonds break, with damping.
struct Crushed {
  double elastic, error, moved;
  std::size_t broken;
  Mat3 stress;
};
Crushed crush(const PackedParticles& p, double skin = 0.3, int steps = 1500) {
  EngineSettings settings;
  settings.skin = skin;
  settings.damping = {0.3, 0.3};
  Bench b = make_bench(p, elastic_brittle(), 0.15, settings);
  b->prepare();
  b->forces();
  b->mark_start_of_loading();
  b->advance();
  Mat3 rate = Mat3::Zero();
  rate(2, 2) = -0.03 / (double(steps) * b->time_step());
  rate(0, 2) = 0.01 / (double(steps) * b->time_step());
  strain(b, rate, steps);
  b->forces();
  const SimulationView v = b->view();
  return {v.energy.elastic, v.energy.error() / v.energy.boundary_work, v.energy.boundary_work, b->broken_bonds(),
          b->cell_stress()};
}

TEST(Periodic, WhereTheCellIsCutDoesNotMatter) {
  const PackedParticles p = periodic_block(7, 7, 8, 1e-3, 4);
  const Crushed one = crush(p, 0.3, 400), other = crush(cut_at(p, Vec3(3.3e-3, -2.1e-3, 5.7e-3)), 0.3, 400);
  EXPECT_GT(one.elastic, 0);
  EXPECT_NEAR(other.elastic, one.elastic, 1e-6 * one.elastic);
  EXPECT_EQ(other.broken, one.broken);
  EXPECT_LT((other.stress - one.stress).norm(), 1e-6 * one.stress.norm());
}

TEST(Periodic, TheLedgerCloses) {
  const Crushed one = crush(periodic_block(7, 7, 8, 1e-3, 5));
  EXPECT_GT(one.broken, 30u) << "the test must break something";
  EXPECT_GT(one.moved, 0);
  EXPECT_LT(std::abs(one.error), 0.01);
}

TEST(Periodic, TheSkinDoesNotMatter) {
  const PackedParticles p = periodic_block(7, 7, 8, 1e-3, 5);
  // Another list adds up in another order; once many bonds have broken, last bits grow.
  const Crushed one = crush(p, 0.3, 500), wide = crush(p, 0.9, 500);
  EXPECT_EQ(wide.broken, one.broken);
  EXPECT_NEAR(wide.elastic, one.elastic, 1e-6 * one.elastic);
}

TEST(Periodic, MomentumIsKept) {
  Bench b = make_bench(periodic_block(6, 6, 7, 1e-3, 6), elastic_brittle(), 0.15);
  b->prepare();
  std::mt19937_64 random(3);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53 - 0.5; };
  double scale = 0;
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    b->hold(k, dof::all, 20 * Vec3(uniform(), uniform(), uniform()), 1e3 * Vec3(uniform(), uniform(), uniform()));
    b->release(k, dof::all);
    scale += b->state().particles.mass()[k] * b->state().particles.velocity()[k].norm();
  }
  const Vec3 before = momentum(b->state());
  Mat3 rate = Mat3::Zero();
  rate(0, 0) = 0.02 / (500 * b->time_step());
  strain(b, rate, 500);
  b->set_cell_velocity(Mat3::Zero());
  b.steps(300);
  EXPECT_LT((momentum(b->state()) - before).norm(), 1e-10 * scale);
  EXPECT_GT(b->broken_bonds(), 10u) << "the test must break something";
}

TEST(Periodic, SameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    EngineSettings settings;
    settings.threads = threads;
    settings.damping = {0.2, 0.2};
    Bench b = make_bench(periodic_block(8, 8, 9, 1e-3, 8), elastic_brittle(), 0.15, settings);
    b->prepare();
    Mat3 rate = Mat3::Zero();
    rate(1, 1) = -0.03 / (800 * b->time_step());
    strain(b, rate, 800);
    b->forces();
    b->view();
    return b->state();
  };
  const State one = run(1);
  ASSERT_GT(std::count_if(one.bonds.state.begin(), one.bonds.state.end(), is_broken), 20);
  for (const int threads : {2, 3, 8}) {
    const State many = run(threads);
    EXPECT_TRUE(same_bits(one.particles.position(), many.particles.position())) << threads;
    EXPECT_TRUE(same_bits(one.particles.velocity(), many.particles.velocity())) << threads;
    EXPECT_EQ(std::memcmp(&one.energy, &many.energy, sizeof one.energy), 0) << threads;
    EXPECT_EQ(one.cell_forces.virial, many.cell_forces.virial) << threads;
  }
}

TEST(Periodic, ACellTooNarrowForItsImagesIsRefused) {
  PackedParticles p = simple_cubic(2, 6, 6, 1e-3);
  p.period = Vec3(4e-3, 12e-3, 12e-3);
  try {
    Bench b = make_bench(p, elastic_brittle(), 1e-6);
    b->prepare();
    FAIL() << "was not refused";
  } catch (const UserError& e) { EXPECT_NE(std::string(e.what()).find("two images"), std::string::npos) << e.what(); }
}

TEST(Periodic, NoWallStandsAcrossADirectionThatRepeatsItself) {
  Bench b = make_bench(periodic_block(6, 6, 6, 1e-3, 9), elastic_brittle(), 0.15);
  EXPECT_THROW(b->add_wall({"upper_platen", Vec3::Zero(), Vec3::UnitZ(), 1e6, 0, 0}), UserError);
}

}  // namespace
}  // namespace breccia::testing
