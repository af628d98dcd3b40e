// SPDX-License-Identifier: BSD-3-Clause
// The same bits for any number of threads, through breakage and rebuilds of the neighbour list.
#include <gtest/gtest.h>

#include <cstring>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

State crushed(int threads) {
  EngineSettings settings;
  settings.threads = threads;
  settings.damping = {0.2, 0.2};
  Bench b = make_bench(random_block(8, 8, 12, 1e-3, 11), elastic_brittle(), 0.15, settings);
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

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Threads, SameBitsForOneTwoThreeAndEight) {
  const State one = crushed(1);
  std::size_t broken = 0;
  for (const BondState s : one.bonds.state) broken += is_broken(s);
  ASSERT_GT(broken, 100u) << "the test must break something";
  ASSERT_NE(one.pairs.size(), one.bonds.size()) << "the test must rebuild its list";
  for (const int threads : {2, 3, 8}) {
    const State many = crushed(threads);
    EXPECT_TRUE(same_bits(one.particles.position, many.particles.position)) << threads;
    EXPECT_TRUE(same_bits(one.particles.velocity, many.particles.velocity)) << threads;
    EXPECT_TRUE(same_bits(one.particles.angular_velocity, many.particles.angular_velocity)) << threads;
    EXPECT_TRUE(same_bits(one.pairs.columns[0], many.pairs.columns[0])) << threads;
    EXPECT_TRUE(same_bits(one.bonds.break_time, many.bonds.break_time)) << threads;
    EXPECT_TRUE(std::memcmp(&one.energy, &many.energy, sizeof one.energy) == 0) << threads;
  }
}

}  // namespace
}  // namespace breccia::testing
