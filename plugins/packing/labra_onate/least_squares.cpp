// SPDX-License-Identifier: BSD-3-Clause
#include "least_squares.hpp"

#include <Eigen/Dense>

#include "breccia/packing_tools/parallel.hpp"

namespace breccia::labra_onate {

namespace {
// Stiffness of a wanted wall relative to a pair: stiff, since the walls are met exactly. It only enters the 4 x 4
// block of the sphere and so costs the preconditioned solver nothing.
constexpr double wall_weight = 100;

double pair_residual(Residual form, double distance, double sum) {
  const double q = distance / sum;
  return form == Residual::distance ? 2 * (q - 1) : q * q - 1;
}

double dot(const std::vector<Vec4>& a, const std::vector<Vec4>& b, int threads) {
  return ordered_sum(a.size(), threads, [&](std::size_t k) { return a[k].dot(b[k]); });
}
}  // namespace

LeastSquares::LeastSquares(const Spheres& s, const Container& box, const NeighbourSet& set, Residual form,
                           bool radii_free, int threads)
    : set_(set),
      radii_free_(radii_free),
      threads_(threads),
      row_(set.partner.size()),
      wall_(s.size()),
      diagonal_(s.size()),
      gradient_(s.size()) {
  for_all(s.size(), threads, [&](std::size_t i) {
    Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
    Vec4 g = Vec4::Zero();
    for (std::size_t e = set.start[i]; e < set.start[i + 1]; ++e) {
      const Index j = set.partner[e];
      const Vec3 d = s.x[i] - s.x[j];
      const double sum = s.r[i] + s.r[j], distance = d.norm(), f = pair_residual(form, distance, sum);
      const double slope = form == Residual::distance ? 2 / (std::max(distance, 1e-9 * sum) * sum) : 2 / (sum * sum);
      row_[e] << slope * d, (radii_free ? -2 / sum : 0.0);
      block += row_[e] * row_[e].transpose();
      g += row_[e] * f;
    }
    std::array<WallDistance, Container::max_walls> walls;
    const std::size_t count = box.walls(s.x[i], walls);
    wall_[i].setZero();
    for (std::size_t w = 0; w < count; ++w) {
      if (!(set.tangent[i] >> w & 1u)) continue;
      Vec4 a;
      a << walls[w].inward, (radii_free ? -1.0 : 0.0);
      a *= 2 / s.r[i];
      wall_[i] += wall_weight * a * a.transpose();
      g += wall_weight * a * (2 / s.r[i]) * (walls[w].distance - s.r[i]);
    }
    diagonal_[i] = block + wall_[i];
    gradient_[i] = g;
  });
  scale_ = ordered_sum(s.size(), threads,
                       [&](std::size_t i) {
                         double trace = 0;
                         for (std::size_t e = set.start[i]; e < set.start[i + 1]; ++e)
                           trace += row_[e].head<3>().squaredNorm();
                         return trace;
                       }) /
           (3 * double(s.size()));
  if (!(scale_ > 0)) scale_ = 1;
}

double LeastSquares::energy(const Spheres& s, const NeighbourSet& set, Residual form, int threads) {
  return ordered_sum(s.size(), threads, [&](std::size_t i) {
    double sum = 0;
    for (const Index j : set.row(i)) {
      const double f = pair_residual(form, (s.x[i] - s.x[j]).norm(), s.r[i] + s.r[j]);
      sum += 0.25 * f * f;  // each pair is seen twice
    }
    return sum;
  });
}

void LeastSquares::multiply(const std::vector<Vec4>& v, double damping, std::vector<Vec4>& out) const {
  for_all(v.size(), threads_, [&](std::size_t i) {
    Vec4 y = wall_[i] * v[i] + (damping * scale_) * v[i];
    for (std::size_t e = set_.start[i]; e < set_.start[i + 1]; ++e) {
      const Vec4 &a = row_[e], &u = v[set_.partner[e]];
      const double t =
          a[0] * (v[i][0] - u[0]) + a[1] * (v[i][1] - u[1]) + a[2] * (v[i][2] - u[2]) + a[3] * (v[i][3] + u[3]);
      y += t * a;
    }
    out[i] = y;
  });
}

std::vector<Vec4> LeastSquares::step(double damping, double tolerance, int max_iterations) const {
  const std::size_t n = gradient_.size();
  std::vector<Eigen::Matrix4d> inverse(n);
  for_all(n, threads_, [&](std::size_t i) {
    Eigen::Matrix4d m = diagonal_[i];
    m.diagonal().array() += damping * scale_;
    inverse[i] = m.llt().solve(Eigen::Matrix4d::Identity());
  });
  std::vector<Vec4> v(n, Vec4::Zero()), residual(n), z(n), p(n), ap(n);
  for_all(n, threads_, [&](std::size_t i) {
    residual[i] = -gradient_[i];
    p[i] = z[i] = inverse[i] * residual[i];
  });
  double rz = dot(residual, z, threads_);
  const double goal = tolerance * tolerance * rz;
  for (int k = 0; k < max_iterations && rz > goal; ++k) {
    multiply(p, damping, ap);
    const double alpha = rz / dot(p, ap, threads_);
    for_all(n, threads_, [&](std::size_t i) {
      v[i] += alpha * p[i];
      residual[i] -= alpha * ap[i];
      z[i] = inverse[i] * residual[i];
    });
    const double next = dot(residual, z, threads_), beta = next / rz;
    rz = next;
    for_all(n, threads_, [&](std::size_t i) { p[i] = z[i] + beta * p[i]; });
  }
  return v;
}

}  // namespace breccia::labra_onate
