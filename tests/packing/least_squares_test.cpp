// SPDX-License-Identifier: BSD-3-Clause
#include "least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace breccia::labra_onate {
namespace {

constexpr int n = 5;

/// Five spheres in a roomy box; every pair is a neighbour, no wall is near.
Spheres five() {
  Spheres s;
  s.x = {Vec3(0, 0, 5), Vec3(1.1, 0.1, 5), Vec3(0.4, 0.9, 5.1), Vec3(0.5, 0.3, 5.8), Vec3(0.2, 1.1, 6.0)};
  s.r = {0.5, 0.6, 0.45, 0.5, 0.55};
  return s;
}

/// All residuals as one vector, written down independently of the code under test.
Eigen::VectorXd residuals(const Spheres& s, const NeighbourSet& set, const Spheres& scale, Residual form) {
  std::vector<double> f;
  for (std::size_t i = 0; i < s.size(); ++i)
    for (const Index j : set.row(i)) {
      if (j < i) continue;
      const double d = (s.x[i] - s.x[j]).norm(), sum = s.r[i] + s.r[j], s0 = scale.r[i] + scale.r[j];
      f.push_back(form == Residual::distance ? 2 * (d - sum) / s0 : (d * d - sum * sum) / (s0 * s0));
    }
  return Eigen::Map<Eigen::VectorXd>(f.data(), Eigen::Index(f.size()));
}

TEST(LeastSquares, StepSolvesTheDampedNormalEquations) {
  const Container box = Container::box(10, 10, 10);
  const Spheres s = five();
  const NeighbourSet set = NeighbourFinder(box, 1).find(s, 7);
  ASSERT_EQ(set.pairs(), 7u);
  for (const Residual form : {Residual::squared_distance, Residual::distance})
    for (const bool radii_free : {true, false}) {
      const int width = radii_free ? 4 : 3;
      const Eigen::VectorXd f = residuals(s, set, s, form);
      Eigen::MatrixXd jacobian(f.size(), width * n);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < width; ++k) {
          const double h = 1e-6;
          Spheres up = s, down = s;
          (k < 3 ? up.x[i][k] : up.r[i]) += h;
          (k < 3 ? down.x[i][k] : down.r[i]) -= h;
          jacobian.col(width * i + k) = (residuals(up, set, s, form) - residuals(down, set, s, form)) / (2 * h);
        }
      Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
      double centres = 0;  // the damping is relative to the mean diagonal over the centres
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) centres += normal(width * i + k, width * i + k) / (3 * n);
      const double damping = 0.03;
      normal.diagonal().array() += damping * centres;
      const Eigen::VectorXd expected = normal.ldlt().solve(-jacobian.transpose() * f);

      const auto step = LeastSquares(s, box, set, form, radii_free, 1).step(damping, 1e-12, 500);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(step[i][k], k < width ? expected[width * i + k] : 0.0, 1e-6);
    }
}

TEST(LeastSquares, EnergyIsHalfTheSumOfSquares) {
  const Container box = Container::box(10, 10, 10);
  const Spheres s = five();
  const NeighbourSet set = NeighbourFinder(box, 1).find(s, 7);
  for (const Residual form : {Residual::squared_distance, Residual::distance})
    EXPECT_NEAR(LeastSquares::energy(s, set, form, 1), 0.5 * residuals(s, set, s, form).squaredNorm(), 1e-14);
}

TEST(LeastSquares, AWantedWallDrawsItsSphere) {
  const Container box = Container::box(10, 10, 10);
  Spheres s;
  s.x = {Vec3(0, 0, 0.55)};
  s.r = {0.5};
  NeighbourSet set = NeighbourFinder(box, 1).find(s, 1);
  ASSERT_EQ(set.tangent[0], 1u << 4);
  const auto step = LeastSquares(s, box, set, Residual::squared_distance, false, 1).step(1e-6, 1e-12, 100);
  EXPECT_NEAR(step[0].z(), -0.05, 1e-4);
  EXPECT_NEAR(step[0].head<2>().norm(), 0, 1e-12);
}

TEST(LeastSquares, CoincidentCentresGiveAFiniteStep) {
  const Container box = Container::box(10, 10, 10);
  Spheres s;
  s.x = {Vec3(0, 0, 5), Vec3(0, 0, 5), Vec3(0.5, 0, 5)};
  s.r = {0.5, 0.5, 0.5};
  const NeighbourSet set = NeighbourFinder(box, 1).find(s, 3);
  for (const Residual form : {Residual::squared_distance, Residual::distance})
    for (const Vec4& v : LeastSquares(s, box, set, form, true, 1).step(0.1, 0.05, 60)) EXPECT_TRUE(v.allFinite());
}

}  // namespace
}  // namespace breccia::labra_onate
