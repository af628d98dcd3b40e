// SPDX-License-Identifier: BSD-3-Clause
// Particles that have flown off: the search for neighbours finds the same pairs, in about the same time.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>

#include "engine/neighbour_search.hpp"

namespace breccia::testing {
namespace {

using Found = std::set<std::pair<Index, Index>>;

/// A cube of n x n x n particles of radius 1, then some in pairs at distances of `far`, in all directions.
Particles cube(int n, double far) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-0.4, 0.4);
  std::vector<Vec3> x;
  for (int k = 0; k < n * n * n; ++k)
    x.push_back(2 * Vec3(k % n, k / n % n, k / n / n) + Vec3(off(random), off(random), off(random)));
  if (far > 0)
    for (const double way : {-1.0, 0.3, 1.0})
      for (int k = 0; k < 3; ++k)
        for (const double beside : {0.0, 1.9}) x.push_back(way * far * Vec3::Unit(k) + Vec3::Constant(beside / 2));
  Particles p;
  p.motion.resize(x.size());
  p.load.resize(x.size());
  for (std::size_t a = 0; a < x.size(); ++a) {
    p.position()[a] = x[a];
    p.radius()[a] = 1;
  }
  return p;
}

Found pairs_of(const Particles& p) {
  const Space space;
  const NeighbourSearch search(space, p, 0.3);
  Found found;
  std::vector<Index> partners;
  for (Index i = 0; i < p.size(); ++i) {
    partners.clear();
    search.append_partners(i, partners);
    for (const Index j : partners) found.emplace(i, j);
  }
  return found;
}

TEST(Strays, AreFoundAsAllOthersAre) {
  for (const double far : {30.0, 1e3, 1e9, 1e150}) {
    const Particles p = cube(7, far);
    Found expected;
    for (Index i = 0; i < p.size(); ++i)
      for (Index j = i + 1; j < p.size(); ++j)
        if ((p.position()[i] - p.position()[j]).norm() < 2.3) expected.emplace(i, j);
    EXPECT_EQ(pairs_of(p), expected) << far;
  }
}

TEST(Strays, DoNotMakeTheSearchSlow) {
  const auto seconds = [](const Particles& p) {
    double least = 1e9;
    for (int k = 0; k < 3; ++k) {
      const auto start = std::chrono::steady_clock::now();
      pairs_of(p);
      least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
  };
  // All in one cell would take a hundred times as long.
  EXPECT_LT(seconds(cube(20, 1e6)), 8 * seconds(cube(20, 0)));
}

}  // namespace
}  // namespace breccia::testing
