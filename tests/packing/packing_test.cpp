// SPDX-License-Identifier: BSD-3-Clause
/// Small packings from end to end: what was asked for is held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "optimiser.hpp"
#include "support.hpp"

namespace breccia::labra_onate {
namespace {

void expect_inside(const PackedParticles& p, const Container& box) {
  ASSERT_EQ(p.position.size(), p.radius.size());
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    std::array<WallDistance, Container::max_walls> walls;
    const std::size_t count = box.walls(p.position[i], walls);
    for (std::size_t w = 0; w < count; ++w) ASSERT_GE(walls[w].distance, p.radius[i] - 1e-9) << i << " at wall " << w;
  }
}

TEST(Packing, CylinderHoldsPorosityRadiiAndWalls) {
  TestHost host;
  const PackedParticles p = pack(small_cylinder(), host);
  const double volume = std::numbers::pi * 0.005 * 0.005 * 0.012;
  double solid = 0, mean = 0, square = 0;
  for (const double r : p.radius) {
    solid += 4 * std::numbers::pi / 3 * r * r * r;
    mean += r / double(p.radius.size());
  }
  for (const double r : p.radius) square += (r - mean) * (r - mean) / double(p.radius.size());
  EXPECT_NEAR(1 - solid / volume, 0.25, 1e-9);
  EXPECT_NEAR(got(p, "radius_factor"), 1, 2e-3);
  EXPECT_NEAR(mean, 0.6e-3, 2e-3 * 0.6e-3);  // the factor that rounds the number of particles off
  EXPECT_NEAR(std::sqrt(square), 0.12e-3, 2e-3 * 0.12e-3);
  EXPECT_NEAR(p.container_volume, volume, 1e-9 * volume);
  EXPECT_EQ(p.outline, SpecimenShape::Outline::cylinder);
  expect_inside(p, Container::cylinder(0.010, 0.012));
  EXPECT_EQ(host.warnings, "");
  EXPECT_TRUE(host.never_back);
  EXPECT_EQ(host.last, 1);
}

TEST(Packing, BoxAndRectangleHoldPorosityAndWalls) {
  TestHost host;
  const PackedParticles box = pack(small_box(), host);
  EXPECT_NEAR(got(box, "porosity"), 0.25, 1e-9);
  EXPECT_EQ(box.outline, SpecimenShape::Outline::box);
  EXPECT_EQ(box.axis, Vec3(Vec3::UnitZ()));
  expect_inside(box, Container::box(0.008, 0.009, 0.011));

  const PackedParticles flat = pack(small_rectangle(), host, 1, 2);
  double area = 0;
  for (const double r : flat.radius) area += std::numbers::pi * r * r;
  EXPECT_NEAR(1 - area / 6e-4, 0.14, 1e-9);
  EXPECT_EQ(flat.axis, Vec3(Vec3::UnitY()));
  EXPECT_NEAR(flat.container_volume, 3e-4, 1e-15);  // the tests' thickness is 0.5 m
  for (const Vec3& x : flat.position) EXPECT_EQ(x.z(), 0);
  expect_inside(flat, Container::rectangle(0.020, 0.030));
}

TEST(Packing, NumberIsExactAndPorosityFollows) {
  Json j = small_cylinder();
  j.erase("porosity");
  j["particles"] = 666;
  TestHost host;
  const PackedParticles p = pack(j, host);
  EXPECT_EQ(p.radius.size(), 666u);
  EXPECT_EQ(got(p, "radius_factor"), 1);
  EXPECT_NEAR(got(p, "radius_mean"), 0.6e-3, 1e-12);
}

TEST(Packing, SpheresAtTheWallsAreTangent) {
  TestHost host;
  const PackedParticles p = pack(small_cylinder(), host);
  EXPECT_EQ(got(p, "tangent_share_at_walls"), 1);
  // A platen must find something to press on: a third of the end face would already be a loose layer.
  for (const char* end : {"particles_on_lower_end", "particles_on_upper_end"})
    EXPECT_GT(got(p, end) * std::numbers::pi * 0.6e-3 * 0.6e-3, 0.33 * std::numbers::pi * 0.005 * 0.005) << end;
}

TEST(Packing, LargeAndSmallSpheresAreMixed) {
  TestHost host;
  const PackedParticles p = pack(small_cylinder(), host);
  const std::size_t n = p.radius.size();
  const Vec3 middle(0, 0, 0.006);
  for (int k = 0; k < 3; ++k) {  // no half holds the larger ones
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (std::size_t i = 0; i < n; ++i) {
      const int half = p.position[i][k] < middle[k] ? 0 : 1;
      sum[half] += p.radius[i];
      ++count[half];
    }
    // Four standard errors of the difference of two means over n/2.
    EXPECT_NEAR(sum[0] / count[0], sum[1] / count[1], 4 * 0.12e-3 * std::sqrt(4 / double(n))) << "axis " << k;
  }
  // Nor do large ones gather with large ones: radii of neighbours are almost uncorrelated.
  double m = 0, both = 0, square = 0, pairs = 0;
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (i != j && (p.position[i] - p.position[j]).norm() < 1.15 * (p.radius[i] + p.radius[j]))
          f(p.radius[i], p.radius[j]);
  };
  each([&](double a, double) {
    m += a;
    ++pairs;
  });
  m /= pairs;
  each([&](double a, double b) {
    both += (a - m) * (b - m);
    square += (a - m) * (a - m);
  });
  EXPECT_LT(std::abs(both / square), 0.15);
}

TEST(Packing, SameSeedSameBitsOtherSeedOtherPacking) {
  TestHost host;
  const PackedParticles a = pack(small_cylinder(), host, 7);
  EXPECT_TRUE(same_bits(a, pack(small_cylinder(), host, 7)));
  EXPECT_FALSE(same_bits(a, pack(small_cylinder(), host, 8)));
}

TEST(Packing, AnyNumberOfThreadsGivesTheSameBits) {
  TestHost host;
  const Container box = Container::cylinder(0.010, 0.012);
  const auto radii = quantile_radii({DistributionFamily::normal, 0.6e-3, 0.12e-3, 0.3e-3, 1.0e-3}, 700);
  const Spheres start = Optimiser(box, radii, {4000, 10, 1e-4, 1}, host).arrange(1);
  std::vector<Spheres> ends;
  for (const int threads : {1, 2, 3}) {
    Optimiser optimiser(box, radii, {4000, 4, 1e-4, threads}, host);
    ends.push_back(start);
    optimiser.optimise_all(ends.back());
    optimiser.optimise_centres(ends.back());
    EXPECT_EQ(ends.back().r, ends.front().r);
    EXPECT_EQ(std::memcmp(ends.back().x.data(), ends.front().x.data(), start.size() * sizeof(Vec3)), 0) << threads;
  }
  EXPECT_NE(ends.front().x, start.x);
}

TEST(Packing, EveryStepLowersTheEnergy) {
  TestHost host;
  const Container box = Container::cylinder(0.010, 0.012);
  const auto radii = quantile_radii({DistributionFamily::normal, 0.6e-3, 0.12e-3, 0.3e-3, 1.0e-3}, 700);
  Optimiser optimiser(box, radii, {4000, 200, 1e-4, 1}, host);
  Spheres s = optimiser.arrange(1);
  const StageRecord all = optimiser.optimise_all(s), centres = optimiser.optimise_centres(s);
  for (const StageRecord* record : {&all, &centres}) {
    ASSERT_GE(record->energy.size(), 2u);
    for (std::size_t k = 1; k < record->energy.size(); ++k) EXPECT_LT(record->energy[k], record->energy[k - 1]);
    EXPECT_TRUE(record->converged);
  }
  EXPECT_LT(centres.energy.back(), 0.6 * all.energy.front());
  std::vector<double> sorted = s.r;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, radii);
}

TEST(Packing, TinyOnesWork) {
  for (const int n : {1, 2, 3, 10})
    for (const int dimension : {2, 3}) {
      Json j = small_cylinder();
      j["container"] = {{"shape", "box"}, {"size", {0.0025, 0.0026, 0.0027}}};
      j.erase("porosity");
      j["particles"] = n;
      j["radius"] = {{"distribution", "normal"}, {"mean", 0.3e-3}, {"standard_deviation", 0.02e-3}};
      TestHost host;
      const PackedParticles p = pack(j, host, 1, dimension);
      ASSERT_EQ(p.radius.size(), std::size_t(n));
      for (const Vec3& x : p.position) EXPECT_TRUE(x.allFinite());
      expect_inside(p, dimension == 2 ? Container::rectangle(0.0025, 0.0026) : Container::box(0.0025, 0.0026, 0.0027));
    }
}

TEST(Packing, StopsWhenCancelled) {
  TestHost host;
  host.cancel_after = 5;
  EXPECT_THROW(pack(small_cylinder(), host), Cancelled);
  EXPECT_LE(host.calls, 6);
}

}  // namespace
}  // namespace breccia::labra_onate
