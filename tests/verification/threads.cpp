// SPDX-License-Identifier: BSD-3-Clause
// The same bits for any number of threads, through breakage and rebuilds of the neighbour list.
#include <gtest/gtest.h>

#include "engine/chunks.hpp"
#include "engine/pair_batch.hpp"
#include "support/same_bits.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

State crushed(int threads, const Json& law, const std::string& name) {
  EngineSettings settings;
  settings.threads = threads;
  settings.damping = {0.2, 0.2};
  Bench b = make_bench(random_block(8, 8, 12, 1e-3, 11), law, 0.15, settings, 3, name);
  const auto& s = b->state().specimen;
  const auto low = b->add_wall({"low", s.base, Vec3::UnitZ(), 15e6, 5e6, 0.3});
  const auto high = b->add_wall({"high", s.base + s.height * Vec3::UnitZ(), -Vec3::UnitZ(), 15e6, 5e6, 0.3});
  b->prepare();
  b->set_wall_velocity(low, 4 * Vec3::UnitZ());
  b->set_wall_velocity(high, -4 * Vec3::UnitZ());
  b.steps(1500);
  b->view();  // folds the sums of the ledger
  return b->state();
}

void expect_same_bits(const Json& law, const std::string& name) {
  const State one = crushed(1, law, name);
  std::size_t broken = 0;
  for (const BondState s : one.bonds.state) broken += is_broken(s);
  ASSERT_GT(broken, 100u) << "the test must break something";
  ASSERT_NE(one.pairs.size(), one.bonds.size()) << "the test must rebuild its list";
  for (const int threads : {2, 3, 8}) {
    const State many = crushed(threads, law, name);
    EXPECT_TRUE(same_bits(one.particles.position(), many.particles.position())) << threads;
    EXPECT_TRUE(same_bits(one.particles.velocity(), many.particles.velocity())) << threads;
    EXPECT_TRUE(same_bits(one.particles.angular_velocity(), many.particles.angular_velocity())) << threads;
    for (std::size_t c = 0; c < one.pairs.columns.size(); ++c)
      EXPECT_TRUE(same_bits(one.pairs.columns[c], many.pairs.columns[c])) << threads << " threads, column " << c;
    EXPECT_TRUE(same_bits(one.pairs.moment, many.pairs.moment)) << threads;
    EXPECT_TRUE(same_bits(one.bonds.cracks, many.bonds.cracks)) << threads;
    EXPECT_TRUE(std::memcmp(&one.energy, &many.energy, sizeof one.energy) == 0) << threads;
  }
}

TEST(Threads, SameBitsForOneTwoThreeAndEight) { expect_same_bits(elastic_brittle(), "elastic_brittle"); }
TEST(Threads, SameBitsWithMoments) { expect_same_bits(nonlinear_tension(), "nonlinear_tension"); }

/// What is summed over pairs knows no cut between blocks of particles.
TEST(Chunks, BeginAnewWithEachBlockOfParticles) {
  Bench b = make_bench(random_block(10, 10, 9, 1e-3, 3), elastic_brittle(), 0.1);
  b->prepare();
  const State& s = b->state();
  const Chunks c = make_chunks(s);
  ASSERT_EQ(c.blocks(), (s.particles.size() + particle_block - 1) / particle_block);
  EXPECT_EQ(c.start.front(), 0u);
  EXPECT_EQ(c.start.back(), s.pairs.size());
  for (std::size_t k = 0; k < c.size(); ++k) {
    const std::size_t count = c.start[k + 1] - c.start[k];
    EXPECT_GT(count, 0u);
    EXPECT_LE(count, PairBatch::chunk);
    EXPECT_EQ(s.pairs.i[c.start[k]] / particle_block, s.pairs.i[c.start[k + 1] - 1] / particle_block);
  }
  for (std::size_t block = 0; block < c.blocks(); ++block) {
    const std::size_t first = c.start[c.block_start[block]];
    EXPECT_GE(s.pairs.i[first], block * particle_block);
    EXPECT_TRUE(first == 0 || s.pairs.i[first - 1] < block * particle_block);
  }
}

}  // namespace
}  // namespace breccia::testing
