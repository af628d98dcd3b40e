// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

/// n x n x n equal spheres that touch, each column pressed along z by `load` [N] at both ends.
FakeSimulation pressed_lattice(int n, double radius, double load) {
  FakeSimulation s;
  const double d = 2 * radius;
  const auto at = [n](int a, int b, int c) { return Index((c * n + b) * n + a); };
  for (int c = 0; c < n; ++c)
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) s.add_particle(d * Vec3(a, b, c), radius);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      for (int c = 0; c + 1 < n; ++c) s.add_bond(at(a, b, c), at(a, b, c + 1), Vec3(0, 0, -load));
      const Index low = at(a, b, 0), high = at(a, b, n - 1);
      s.wall_contacts.push_back({low, 0, s.position[low] - Vec3(0, 0, radius), Vec3(0, 0, load)});
      s.wall_contacts.push_back({high, 1, s.position[high] + Vec3(0, 0, radius), Vec3(0, 0, -load)});
    }
  s.specimen.volume = std::pow(n * d, 3);
  return s;
}

TEST(Stress, OfPressedLatticeIsLoadOverArea) {
  const double radius = 1e-3, load = 7.0, expected = load / (4 * radius * radius);
  const FakeSimulation s = pressed_lattice(5, radius, load);
  LoadedPostprocessor p("stress");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_NEAR(p.curves.last("stress_zz"), -expected, 1e-12 * expected);
  EXPECT_NEAR(p.curves.last("axial_stress"), expected, 1e-12 * expected);
  EXPECT_NEAR(p.curves.last("mean_stress"), expected / 3, 1e-12 * expected);
  EXPECT_NEAR(p.curves.last("deviatoric_stress"), expected, 1e-12 * expected);
  for (const char* zero : {"stress_xx", "stress_yy", "stress_xy", "stress_yz", "stress_zx", "lateral_stress"})
    EXPECT_NEAR(p.curves.last(zero), 0, 1e-12 * expected) << zero;
}

TEST(Stress, OfEachParticleAddsUpToTheWhole) {
  const double radius = 1e-3, load = 7.0;
  const FakeSimulation s = pressed_lattice(4, radius, load);
  LoadedPostprocessor p("stress");
  p.begin(s.view());
  // Sphere volume over its cell of the lattice is pi/6.
  const double expected = load / (4 * radius * radius) / 3 / (M_PI / 6);
  for (const double v : p.field(s.view(), "pressure")) EXPECT_NEAR(v, expected, 1e-12 * expected);
}

/// sum of V_p sigma_p over V is the mean stress of the specimen: what a contact adds to its two particles is its branch
/// vector (x) force, in pieces. With spheres of several sizes, overlaps and gaps, and forces in any direction.
TEST(Stress, TensorsOfTheParticlesAddUpToThatOfTheSpecimen) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const int dimension : {3, 2}) {
    FakeSimulation s;
    s.dimension = dimension;
    s.thickness = 0.3;
    const auto vector = [&] { return Vec3(u(random), u(random), dimension == 3 ? u(random) : 0); };
    for (int k = 0; k < 50; ++k) s.add_particle(vector(), 0.1 + 0.05 * u(random));
    for (Index i = 0; i < 50; ++i)
      for (Index j = i + 1; j < 50; ++j)
        if ((s.position[i] - s.position[j]).norm() < 0.6) s.add_bond(i, j, vector());
    for (Index k = 0; k < 50; k += 3) s.wall_contacts.push_back({k, 0, s.position[k] + 0.1 * vector(), vector()});
    s.specimen.volume = 2.5;
    s.specimen.axis = Vec3::UnitY();
    LoadedPostprocessor p("stress");
    p.begin(s.view());
    p.sample(s.view());
    const std::vector<double> tensor = p.field(s.view(), "stress");
    ASSERT_EQ(tensor.size(), 6 * s.radius.size());
    double sum[6] = {}, scale = 0;
    for (std::size_t k = 0; k < tensor.size(); ++k) {
      const double share = s.view().solid_volume(s.radius[k / 6]) / s.specimen.volume * tensor[k];
      sum[k % 6] += share;
      scale += std::abs(share);
    }
    const char* const components[6] = {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(sum[c], p.curves.last(components[c]), 1e-13 * scale) << components[c] << " " << dimension;
    const std::vector<double> pressure = p.field(s.view(), "pressure");
    for (std::size_t k = 0; k < pressure.size(); ++k)
      EXPECT_NEAR(pressure[k], -(tensor[6 * k] + tensor[6 * k + 1] + tensor[6 * k + 2]) / dimension, 1e-13 * scale);
  }
}

TEST(Stress, FollowsTheAxisOfTheSpecimen) {
  FakeSimulation s = pressed_lattice(3, 1e-3, 5.0);
  s.specimen.axis = Vec3::UnitX();
  LoadedPostprocessor p("stress");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_NEAR(p.curves.last("axial_stress"), 0, 1e-6);
  EXPECT_NEAR(p.curves.last("lateral_stress"), 0.5 * 5.0 / 4e-6, 1e-6);
}

/// Any pair forces: the external forces that hold each particle in place, taken as a wall contact at a point off its
/// centre, must give the same stress as the boundary average of position (x) force, whatever the origin.
TEST(Stress, EqualsTheBoundaryAverageInEquilibrium) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  FakeSimulation s;
  for (int k = 0; k < 60; ++k) s.add_particle(Vec3(u(random), u(random), u(random)) + Vec3(3, -2, 5), 0.1);
  std::vector<Vec3> unbalanced(60, Vec3::Zero());
  for (Index i = 0; i < 60; ++i)
    for (Index j = i + 1; j < 60; ++j) {
      if ((s.position[i] - s.position[j]).norm() > 0.7) continue;
      const Vec3 n = (s.position[j] - s.position[i]).normalized(), f = (u(random) * n).eval();
      s.add_bond(i, j, f);
      unbalanced[i] += f;
      unbalanced[j] -= f;
    }
  s.specimen.volume = 8;
  Mat3 boundary = Mat3::Zero();
  double scale = 0;
  for (Index k = 0; k < 60; ++k) {
    const Vec3 point = s.position[k] + 0.1 * Vec3(u(random), u(random), u(random)).normalized();
    s.wall_contacts.push_back({k, 0, point, -unbalanced[k]});
    boundary -= point * unbalanced[k].transpose() / s.specimen.volume;
    scale += unbalanced[k].norm() / s.specimen.volume;
  }
  ASSERT_GT(scale, 1);
  LoadedPostprocessor p("stress");
  p.begin(s.view());
  p.sample(s.view());
  const Mat3 e = 0.5 * (boundary + boundary.transpose());
  EXPECT_NEAR(p.curves.last("stress_xx"), e(0, 0), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_yy"), e(1, 1), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_zz"), e(2, 2), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_xy"), e(0, 1), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_yz"), e(1, 2), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_zx"), e(2, 0), 1e-12 * scale);
  EXPECT_NEAR(p.curves.last("stress_skew_part"), (boundary - e).norm(), 1e-12 * scale);
}

TEST(Stress, InTwoDimensionsUsesTheThickness) {
  FakeSimulation s;
  s.dimension = 2;
  s.thickness = 0.5;
  s.add_particle(Vec3(0, 0, 0), 1);
  s.add_particle(Vec3(0, 2, 0), 1);
  s.add_bond(0, 1, Vec3(0, -6, 0));
  s.wall_contacts = {{0, 0, Vec3(0, -1, 0), Vec3(0, 6, 0)}, {1, 1, Vec3(0, 3, 0), Vec3(0, -6, 0)}};
  s.specimen.axis = Vec3::UnitY();
  s.specimen.volume = 2 * 4 * 0.5;
  LoadedPostprocessor p("stress");
  p.begin(s.view());
  p.sample(s.view());
  EXPECT_DOUBLE_EQ(p.curves.last("axial_stress"), 6 / (2 * 0.5));
  EXPECT_DOUBLE_EQ(p.curves.last("lateral_stress"), 0);
  EXPECT_DOUBLE_EQ(p.curves.last("mean_stress"), 3);
  EXPECT_DOUBLE_EQ(p.curves.last("deviatoric_stress"), 6);
  for (const double v : p.field(s.view(), "pressure")) EXPECT_NEAR(v, 6 * 2 / (M_PI * 0.5) / 2, 1e-12);
}

TEST(Stress, WithoutVolumeIsTheUsersError) {
  FakeSimulation s;
  s.add_particle(Vec3::Zero(), 1);
  LoadedPostprocessor p("stress");
  EXPECT_THROW(p.begin(s.view()), UserError);
}

}  // namespace
}  // namespace breccia::test
