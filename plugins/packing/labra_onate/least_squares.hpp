// SPDX-License-Identifier: BSD-3-Clause
/// The sparse nonlinear least-squares problem of one neighbour set, and one Levenberg-Marquardt step of it.
///
/// Residuals: f_ij = (|x_i - x_j|^2 - (r_i + r_j)^2)/s_ij, with s_ij frozen (see `Weighting`), and for each wanted wall
/// its distance minus r. The step solves (J^T J + lambda D) v = -J^T f by conjugate gradients, preconditioned with the
/// 4 x 4 block of each sphere; J^T J is never formed.
#pragma once

#include "neighbours.hpp"

namespace breccia::labra_onate {

using Vec4 = Eigen::Vector4d;  ///< of a sphere: change of its centre and of its radius [m]

enum class Residual {
  squared_distance,  ///< (d^2 - s^2)/s^2: the objective of the method
  distance           ///< 2 (d - s)/s: pushes deep overlaps apart, where the other loses its grip
};

class LeastSquares {
 public:
  LeastSquares(const Spheres& s, const Container& box, const NeighbourSet& set, Residual form, bool radii_free,
               int threads);

  /// Half the sum of the squared residuals [1], for spheres of the same number near those of the constructor.
  static double energy(const Spheres& s, const NeighbourSet& set, Residual form, int threads);

  /// The step for a damping; `tolerance` of the linear solver relative to the gradient.
  std::vector<Vec4> step(double damping, double tolerance, int max_iterations) const;

 private:
  void multiply(const std::vector<Vec4>& v, double damping, std::vector<Vec4>& out) const;

  const NeighbourSet& set_;
  bool radii_free_;
  int threads_;
  std::vector<Vec4> row_;  // of J, per entry of set_.partner: d f/d(x_i, r_i)
  std::vector<Eigen::Matrix4d> wall_, diagonal_;
  std::vector<Vec4> gradient_;  // J^T f
  double scale_ = 1;            // mean diagonal of J^T J over the centres: makes the damping dimensionless
};

}  // namespace breccia::labra_onate
