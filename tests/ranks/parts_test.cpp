// SPDX-License-Identifier: BSD-3-Clause
// A specimen in parts moves, breaks and counts as one that is whole, to the last bit: through new neighbours, and as
// particles change their ranks.
#include "engine/parts.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "archive/memory_archive.hpp"
#include "ranks/thread_ranks.hpp"
#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

struct Case {
  const char* name;
  std::string law = "elastic_brittle";
  EngineSettings settings;
  int dimension = 3;
  bool periodic = false;
  int steps = 800;
};

EngineSettings damped(TimeStep step = TimeStep::bound, double added_mass = 0) {
  EngineSettings s;
  s.damping = {0.2, 0.2};
  s.time_step = step;
  s.added_mass = added_mass;
  return s;
}

std::vector<Case> cases() {
  return {{"crushed", "elastic_brittle", damped()},
          {"with_moments", "nonlinear_tension", damped()},
          {"in_the_plane", "elastic_brittle", damped(), 2, false, 1200},
          {"step_of_the_fastest_mode", "elastic_brittle", damped(TimeStep::spectral, 0.01)},
          {"periodic", "elastic_brittle", damped(), 3, true}};
}

/// What all ranks together end with, seen on the first; and on the way a checkpoint.
struct End {
  State state;
  EnergyLedger energy;
  double unbalanced = 0, step = 0, stiffness = 0, speed = 0;
  std::size_t broken = 0;
  std::uint64_t rebuilds = 0;
  Vec3 wall = Vec3::Zero();
  Mat3 stress = Mat3::Zero();
  std::vector<double> heights;  ///< as a protocol sees the particles
};

PackedParticles packing_of(const Case& c) {
  PackedParticles p = c.dimension == 2 ? random_block(40, 40, 1, 1e-3, 5) : random_block(10, 10, 16, 1e-3, 11);
  if (c.dimension == 2)
    for (Vec3& x : p.position) x.z() = 0;
  if (c.periodic) p.period = Vec3(20e-3, 20e-3, 32e-3);
  return p;
}

/// Law, specimen and loading; the law outlives the simulation.
Bench begun(const Case& c, RankLink* link) {
  EngineSettings settings = c.settings;
  settings.link = link;
  const bool moments = c.law == "nonlinear_tension";
  Bench b = make_bench(packing_of(c), moments ? nonlinear_tension() : elastic_brittle({{"tensile_strength", 5e6}}),
                       0.15, settings, c.dimension, c.law);
  if (!c.periodic) {
    const Vec3 up = c.dimension == 2 ? Vec3::UnitY() : Vec3::UnitZ();
    const SpecimenShape s = b->set_specimen_axis(up);
    const auto low = b->add_wall({"low", s.base, up, 15e6, 5e6, 0.3});
    const auto high = b->add_wall({"high", s.base + s.height * up, -up, 15e6, 5e6, 0.3});
    b->prepare();
    b->set_wall_velocity(low, 4 * up);
    b->set_wall_velocity(high, -4 * up);
  } else {
    b->prepare();
    Mat3 velocity = Mat3::Zero();
    velocity(2, 2) = -5;
    velocity(0, 2) = 2;
    b->set_cell_velocity(velocity);
  }
  return b;
}

/// Steps in which a protocol loads some particles, holds some, and lets them go.
void go(Bench& b, int from, int to) {
  const Index n = 1500;
  for (int k = from; k < to; ++k) {
    if (k % 100 == 3)
      for (Index a = 0; a < n; a += 71) b->set_applied_force(a, Vec3(0.01 * (k % 7), 0, 0), Vec3::Zero(), Mat3::Zero());
    if (k % 300 == 50)
      for (Index a = 100; a < n; a += 370) b->hold(a, dof::all, Vec3(0, 0, 0.1), Vec3::Zero());
    if (k % 300 == 150)
      for (Index a = 100; a < n; a += 370) b->release(a, dof::all);
    b->forces(k % 50 == 0);
    if (k == 100) b->mark_start_of_loading();
    if (k % 50 == 0) b->view();
    b->advance();
  }
}

void finish(Bench& b, End& end, bool first) {
  b->forces();
  const double unbalanced = b->unbalanced_force_ratio(), stiffness = b->bond_stiffness().modulus,
               speed = b->fastest_boundary();
  const EnergyLedger energy = b->view().energy;
  std::vector<double> heights;
  for (const Vec3& x : b->particles().position) heights.push_back(x.z() + x.y());
  if (!first) return;
  end = {b->state(),    energy, unbalanced, b->time_step(), stiffness, speed, b->broken_bonds(),
         b->rebuilds(), {},     {},         heights};
  if (!end.state.walls.empty()) end.wall = end.state.walls[1].force;
  end.stress = end.state.cell_forces.virial;
}

template <class T>
bool same(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void expect_same(const End& a, const End& b, const std::string& what) {
  const State &s = a.state, &t = b.state;
  EXPECT_EQ(a.rebuilds, b.rebuilds) << what;
  EXPECT_EQ(a.broken, b.broken) << what;
  EXPECT_TRUE(same(a.step, b.step)) << what;
  EXPECT_TRUE(same_bits(s.particles.position(), t.particles.position())) << what;
  EXPECT_TRUE(same_bits(s.particles.velocity(), t.particles.velocity())) << what;
  EXPECT_TRUE(same_bits(s.particles.angular_velocity(), t.particles.angular_velocity())) << what;
  EXPECT_TRUE(same_bits(s.particles.force(), t.particles.force())) << what;
  EXPECT_TRUE(same_bits(s.particles.torque(), t.particles.torque())) << what;
  EXPECT_EQ(s.particles.held, t.particles.held) << what;
  EXPECT_EQ(s.particles.id, t.particles.id) << what;
  EXPECT_EQ(s.pairs.i, t.pairs.i) << what;
  EXPECT_EQ(s.pairs.j, t.pairs.j) << what;
  EXPECT_EQ(s.pairs.bond, t.pairs.bond) << what;
  EXPECT_EQ(s.pairs.state, t.pairs.state) << what;
  EXPECT_TRUE(same_bits(s.pairs.rest_length, t.pairs.rest_length)) << what;
  for (std::size_t c = 0; c < s.pairs.columns.size(); ++c)
    EXPECT_TRUE(same_bits(s.pairs.columns[c], t.pairs.columns[c])) << what << ", column " << c;
  EXPECT_TRUE(same_bits(s.pairs.force, t.pairs.force)) << what;
  EXPECT_TRUE(same_bits(s.pairs.moment, t.pairs.moment)) << what;
  EXPECT_EQ(s.bonds.state, t.bonds.state) << what;
  EXPECT_EQ(s.bonds.pair, t.bonds.pair) << what;
  EXPECT_EQ(s.bonds.crack_of, t.bonds.crack_of) << what;
  EXPECT_TRUE(same_bits(s.bonds.cracks, t.bonds.cracks)) << what;
  EXPECT_TRUE(same_bits(s.bonds.released, t.bonds.released)) << what;
  EXPECT_EQ(s.wall_touches.size(), t.wall_touches.size()) << what;
  EXPECT_TRUE(same(a.energy, b.energy)) << what;
  EXPECT_TRUE(same(a.unbalanced, b.unbalanced)) << what;
  EXPECT_TRUE(same(a.stiffness, b.stiffness)) << what;
  EXPECT_TRUE(same(a.speed, b.speed)) << what;
  EXPECT_TRUE(same(a.wall, b.wall)) << what;
  EXPECT_TRUE(same(a.stress, b.stress)) << what;
  EXPECT_TRUE(same_bits(a.heights, b.heights)) << what;
}

class Parts : public ::testing::TestWithParam<Case> {};

TEST_P(Parts, AreTheWholeToTheLastBit) {
  const Case& c = GetParam();
  const int half = c.steps / 2;
  End one;
  MemoryArchive kept;
  {
    Bench b = begun(c, nullptr);
    go(b, 0, half);
    b->archive(kept);
    go(b, half, c.steps);
    finish(b, one, true);
  }
  ASSERT_GT(one.broken, 100u) << "the test must break something";
  ASSERT_GT(one.rebuilds, 3u) << "the test must rebuild its list";
  for (const int ranks : {2, 3, 5}) {
    // Ten: never; -1: particles change their ranks whenever the list is made anew.
    for (const double tolerated : {10.0, -1.0}) {
      if (ranks == 2 && tolerated < 0) continue;  // the more there are the more there is to change
      End many;
      MemoryArchive written;  // by all together, each its share
      on_ranks(
          ranks,
          [&](RankLink* link) {
            Bench b = begun(c, link);
            go(b, 0, half);
            SharedMemoryArchive shared(link);
            b->archive(shared);
            if (link->first()) written.read_back(shared);
            go(b, half, c.steps);
            finish(b, many, link->first());
          },
          tolerated);
      const std::string what = std::to_string(ranks) + " ranks, tolerated " + std::to_string(tolerated);
      expect_same(one, many, what);
      EXPECT_EQ(kept.difference(written), "") << what;
    }
    if (ranks == 2) continue;
    // What was written goes on with several.
    End on;
    on_ranks(ranks, [&](RankLink* link) {
      Bench b = begun(c, link);
      MemoryArchive from;
      from.read_back(kept);
      b->archive(from);
      go(b, half, c.steps);
      finish(b, on, link->first());
    });
    expect_same(one, on, "resumed on " + std::to_string(ranks));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Parts, ::testing::ValuesIn(cases()), [](const auto& its) { return its.param.name; });

}  // namespace
}  // namespace breccia::testing
