// SPDX-License-Identifier: BSD-3-Clause
#include "neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace breccia::labra_onate {
namespace {

Spheres cloud(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto u = [&] { return double(generator() >> 11) * 0x1p-53; };
  Spheres s;
  for (std::size_t k = 0; k < n; ++k) {
    s.r.push_back(0.05 + 0.08 * u());
    s.x.emplace_back(u() - 0.5, u() - 0.5, u());
  }
  return s;
}

/// Relative gaps of all pairs, ascending.
std::vector<double> all_gaps(const Spheres& s) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = i + 1; j < s.size(); ++j) gaps.push_back((s.x[i] - s.x[j]).norm() / (s.r[i] + s.r[j]) - 1);
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

void expect_set(const Spheres& s, const NeighbourSet& set, std::size_t pairs) {
  const auto gaps = all_gaps(s);
  const auto below = [&](double gap) { return std::size_t(std::ranges::lower_bound(gaps, gap) - gaps.begin()); };
  const std::size_t overlaps = below(0.0), within = below(NeighbourFinder::widest_gap);
  EXPECT_EQ(set.pairs(), pairs == 0 ? overlaps : std::max(overlaps, std::min(pairs, within)));
  for (std::size_t i = 0; i < s.size(); ++i)
    for (const Index j : set.row(i)) {
      EXPECT_LE((s.x[i] - s.x[j]).norm() / (s.r[i] + s.r[j]) - 1, set.tolerance + 1e-12);
      EXPECT_TRUE(std::ranges::count(set.row(j), Index(i)) == 1);
    }
}

TEST(Neighbours, AreThePairsWithTheSmallestGaps) {
  const Container box = Container::box(1, 1, 1);
  const Spheres s = cloud(150, 3);
  for (const std::size_t pairs : {0u, 10u, 500u, 700u, 100000u}) {
    SCOPED_TRACE(pairs);
    expect_set(s, NeighbourFinder(box, 1).find(s, pairs), pairs);
  }
}

TEST(Neighbours, AreFoundAfterMovesSmallAndLarge) {
  const Container box = Container::box(1, 1, 1);
  Spheres s = cloud(150, 3);
  const Spheres other = cloud(150, 4);
  NeighbourFinder finder(box, 1);
  finder.find(s, 600);
  for (const double share : {0.01, 0.02, 0.5}) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      s.x[i] += share * (other.x[i] - s.x[i]);
      s.r[i] += share * (other.r[i] - s.r[i]);
    }
    SCOPED_TRACE(share);
    expect_set(s, finder.find(s, 600), 600);
  }
}

TEST(Neighbours, WantTheWallsTheyAlmostTouch) {
  const Container box = Container::box(1, 1, 1);
  Spheres s;
  s.x = {Vec3(0, 0, 0.11), Vec3(0, 0, 0.21), Vec3(0.39, 0, 0.5)};  // a pair, its lower near the floor; one at a side
  s.r = {0.1, 0.01, 0.1};
  s.x[1].z() = 0.11 + 0.11 * 1.15;  // the pair's relative gap: 0.15
  const NeighbourSet set = NeighbourFinder(box, 1).find(s, 1);
  EXPECT_EQ(set.tangent[0], 1u << 4);
  EXPECT_EQ(set.tangent[1], 0u);
  EXPECT_EQ(set.tangent[2], 1u << 1);
}

}  // namespace
}  // namespace breccia::labra_onate
