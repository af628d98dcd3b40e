// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "breccia/error.hpp"
#include "mean_strain.hpp"

namespace breccia {
namespace {

constexpr double no_gap_limit = 1e9;

struct Points {
  std::vector<Vec3> centre;
  std::vector<double> radius;
};

Points random_points(int count, int dimension, double radius_spread) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> u(0, 1);
  Points p;
  for (int k = 0; k < count; ++k) {
    const double x = u(random), y = u(random), z = u(random);
    p.centre.push_back(Vec3(x, y, dimension == 3 ? z : 0.0));
    p.radius.push_back(0.02 + radius_spread * u(random));
  }
  return p;
}

/// The corners of the unit cube first, so that the hull is known.
Points random_in_cube(int count, int dimension) {
  Points p = random_points(count, dimension, 0.03);
  for (int c = 0; c < (dimension == 3 ? 8 : 4); ++c) {
    p.centre[c] = Vec3(c & 1, c >> 1 & 1, c >> 2 & 1);
    p.radius[c] = 0.02;
  }
  return p;
}

Points lattice(int n, int dimension, double spacing) {
  Points p;
  for (int c = 0; c < (dimension == 3 ? n : 1); ++c)
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        p.centre.push_back(spacing * Vec3(a, b, c));
        p.radius.push_back(0.5 * spacing);
      }
  return p;
}

double volume(const Triangulation& t, const Points& p) {
  double v = 0;
  for (std::size_t s = 0; s < t.simplices.size(); ++s) v += simplex_volume(t, s, p.centre);
  return v;
}

TEST(Triangulation, FillsTheHull) {
  for (const int dimension : {2, 3}) {
    const Points p = random_in_cube(1500, dimension);
    const Triangulation t = triangulate(dimension, p.centre, p.radius);
    for (std::size_t s = 0; s < t.simplices.size(); ++s) ASSERT_GT(simplex_volume(t, s, p.centre), 0);
    EXPECT_NEAR(volume(t, p), 1, 1e-8) << dimension;  // less the flat simplices left out
  }
}

/// The defining property: no other sphere is closer, in power, to the orthogonal centre of a simplex than its corners.
TEST(Triangulation, IsRegular) {
  for (const int dimension : {2, 3}) {
    const Points p = random_points(300, dimension, 0.1);
    const Triangulation t = triangulate(dimension, p.centre, p.radius);
    std::vector<char> seen(p.centre.size(), 0);
    for (const auto& s : t.simplices) {
      const Vec3 a = p.centre[s[0]];
      Mat3 rows = Mat3::Identity();
      Vec3 right = Vec3::Zero();
      for (int k = 0; k < dimension; ++k) {
        const Vec3 edge = p.centre[s[k + 1]] - a;
        const double ra = p.radius[s[0]], rb = p.radius[s[k + 1]];
        rows.row(k) = edge;
        right[k] = 0.5 * (edge.squaredNorm() + ra * ra - rb * rb);
      }
      const Vec3 centre = a + rows.inverse() * right;
      const double power = (centre - a).squaredNorm() - p.radius[s[0]] * p.radius[s[0]];
      for (std::size_t q = 0; q < p.centre.size(); ++q) {
        const double distance2 = (centre - p.centre[q]).squaredNorm();
        EXPECT_GE(distance2 - p.radius[q] * p.radius[q], power - 1e-6 - 1e-8 * distance2);
      }
      for (int k = 0; k <= dimension; ++k) seen[s[k]] = 1;
    }
    EXPECT_LT(std::count(seen.begin(), seen.end(), 1), 300) << "this sample has hidden spheres";
  }
}

TEST(Triangulation, CutsLatticesFaceToFace) {
  for (const int dimension : {2, 3})
    for (const int n : {2, 3, 9}) {
      const Points p = lattice(n, dimension, 1e-3);
      const double side = (n - 1) * 1e-3;
      const Triangulation t = triangulate(dimension, p.centre, p.radius);
      EXPECT_NEAR(volume(t, p), std::pow(side, dimension), 1e-12 * std::pow(side, dimension));
      // Face to face exactly when the faces around each inner point close.
      std::vector<Vec3> sum(p.centre.size(), Vec3::Zero());
      for (std::size_t s = 0; s < t.simplices.size(); ++s) {
        const auto g = shape_gradients(t, s, p.centre);
        for (int a = 0; a < t.corners(); ++a) sum[t.simplices[s][a]] += g[a];
      }
      for (std::size_t k = 0; k < sum.size(); ++k) {
        bool inside = true;
        for (int c = 0; c < dimension; ++c) inside = inside && p.centre[k][c] > 1e-6 && p.centre[k][c] < side - 1e-6;
        if (!inside) continue;
        EXPECT_LT(sum[k].norm(), 1e-12 * std::pow(1e-3, dimension - 1));
      }
    }
}

TEST(Triangulation, PeelsOnlyFromOutside) {
  // Two blocks of a lattice, three spacings apart: the bridge between them is no part of the assembly.
  Points p = lattice(4, 3, 1.0);
  const std::size_t one = p.centre.size();
  for (std::size_t k = 0; k < one; ++k) {
    p.centre.push_back(p.centre[k] + Vec3(6, 0, 0));
    p.radius.push_back(p.radius[k]);
  }
  Triangulation t = triangulate(3, p.centre, p.radius);
  EXPECT_NEAR(volume(t, p), 9 * 9, 1e-9);
  EXPECT_GT(peel_hull(t, p.centre, p.radius, 1.0), 0u);
  EXPECT_NEAR(volume(t, p), 2 * 27, 1e-9);

  // A hole inside stays filled: there is no way to it from outside.
  Points hollow = lattice(7, 3, 1.0);
  for (std::size_t k = hollow.centre.size(); k-- > 0;)
    if ((hollow.centre[k] - Vec3(3, 3, 3)).norm() < 1.5) {
      hollow.centre.erase(hollow.centre.begin() + long(k));
      hollow.radius.erase(hollow.radius.begin() + long(k));
    }
  t = triangulate(3, hollow.centre, hollow.radius);
  double longest = 0;
  for (const auto& c : t.simplices)
    for (int k = 0; k < 3; ++k) longest = std::max(longest, (hollow.centre[c[k]] - hollow.centre[c[k + 1]]).norm());
  ASSERT_GT(longest, 2.0) << "simplices across the hole would be peeled on the outline";
  EXPECT_EQ(peel_hull(t, hollow.centre, hollow.radius, 1.0), 0u);
  EXPECT_NEAR(volume(t, hollow), 216, 1e-9);
}

TEST(Triangulation, RefusesWhatSpansNothing) {
  const Points flat = random_points(50, 2, 0);
  EXPECT_THROW(triangulate(3, flat.centre, flat.radius), UserError);
  std::vector<Vec3> line;
  for (int k = 0; k < 9; ++k) line.push_back(Vec3(k, 2 * k, 0));
  EXPECT_THROW(triangulate(2, line, std::vector<double>(9, 0.1)), UserError);
  const Points few = random_points(3, 3, 0);
  try {
    triangulate(3, few.centre, few.radius);
    FAIL();
  } catch (const UserError& e) { EXPECT_NE(std::string(e.what()).find("3 particles"), std::string::npos) << e.what(); }
  EXPECT_THROW(triangulate(3, std::vector<Vec3>(20, Vec3(1, 2, 3)), std::vector<double>(20, 0.1)), UserError);
}

TEST(Triangulation, TakesRepeatedCentres) {
  Points p = random_in_cube(100, 3);
  for (int k = 0; k < 30; ++k) {
    p.centre.push_back(p.centre[k]);
    p.radius.push_back(p.radius[k]);
  }
  const Triangulation t = triangulate(3, p.centre, p.radius);
  EXPECT_NEAR(volume(t, p), 1, 1e-8);
}

TEST(MeanStrain, WeightsSumToZeroAndVanishInside) {
  const Points p = random_in_cube(800, 3);
  const MeanStrain m(3, p.centre, p.radius, no_gap_limit);
  Vec3 sum = Vec3::Zero();
  double largest = 0;
  for (const Vec3& w : m.weights()) {
    sum += w;
    largest = std::max(largest, w.norm());
  }
  EXPECT_LT(sum.norm(), 1e-13 * largest * 800);
  EXPECT_NEAR(m.report().volume, 1, 1e-8);
  EXPECT_LT(m.report().boundary, 200u);
}

TEST(MeanStrain, HiddenParticleShowsItsNeighboursStrain) {
  Points p = lattice(4, 3, 1.0);
  p.centre.push_back(Vec3(1.1, 1.0, 1.0));
  p.radius.push_back(0.05);
  const MeanStrain m(3, p.centre, p.radius, no_gap_limit);
  EXPECT_EQ(m.report().hidden, 1u);
  std::vector<Vec3> moved = p.centre;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(-1e-3, 1e-3);
  for (Vec3& x : moved) x += Vec3(u(random), u(random), u(random));
  const auto local = m.local_gradients(moved);
  const std::size_t host = 1 + 4 * (1 + 4 * 1);
  EXPECT_TRUE(local.back().isApprox(local[host], 0));
  EXPECT_GT(local.back().norm(), 0);
}

TEST(MeanStrain, WithoutAnythingFilledIsTheUsersError) {
  const Points p = lattice(3, 3, 1.0);
  EXPECT_THROW(MeanStrain(3, p.centre, std::vector<double>(p.centre.size(), 0.01), 0.1), UserError);
}

}  // namespace
}  // namespace breccia
