// SPDX-License-Identifier: BSD-3-Clause
#include "engine/time_step.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

#include "engine/neighbours.hpp"
#include "engine/walls.hpp"

namespace breccia {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Stiffness of one end of a contact: normal n seen from the particle, lever arm along it.
void add_contact(Mat6& k, const Vec3& n, double arm, const ContactStiffness& c) {
  const Mat3 nn = n * n.transpose(), tangent = Mat3::Identity() - nn;
  Mat3 cross;  // cross * v = n x v
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  // The contact point moves by u + w x (arm n) = u - arm (n x w).
  k.topLeftCorner<3, 3>() += c.normal * nn + c.shear * tangent;
  k.topRightCorner<3, 3>() += -c.shear * arm * cross;
  k.bottomLeftCorner<3, 3>() += c.shear * arm * cross;
  k.bottomRightCorner<3, 3>() += (c.shear * arm * arm + c.bending) * tangent + c.torsion * nn;
}

}  // namespace

double critical_time_step(State& s, ContactLaw& law, const std::vector<Index>& particles) {
  if (particles.empty()) return std::numeric_limits<double>::infinity();
  const Particles& p = s.particles;
  std::vector<Mat6> k(p.size(), Mat6::Zero());
  std::vector<double*> columns;
  const PairBatch batch = whole_batch(s, columns);
  std::vector<ContactStiffness> stiffness(s.pairs.size());
  law.stiffness(batch, stiffness.data());
  for (std::size_t q = 0; q < s.pairs.size(); ++q) {
    const Index i = s.pairs.i[q], j = s.pairs.j[q];
    const Vec3 branch = p.position[j] - p.position[i];
    const double d = branch.norm(), half_gap = 0.5 * (d - p.radius[i] - p.radius[j]);
    if (d <= 0) continue;
    add_contact(k[i], branch / d, p.radius[i] + half_gap, stiffness[q]);
    add_contact(k[j], -branch / d, p.radius[j] + half_gap, stiffness[q]);
  }
  for (const WallTouch& t : s.wall_touches) {
    const Wall& w = s.walls[t.wall];
    add_contact(k[t.particle], -facing(w, p.position[t.particle]).normal, p.radius[t.particle], {w.normal_stiffness, w.friction > 0 ? w.shear_stiffness : 0, 0, 0});
  }
  double most = 0;
  for (const Index a : particles) {
    Eigen::Matrix<double, 6, 1> scale;
    const double m = 1 / std::sqrt(p.mass[a]), r = 1 / std::sqrt(p.inertia[a]);
    scale << m, m, m, r, r, r;
    for (int c = 0; c < 6; ++c)
      if (p.held[a] >> c & 1) scale[c] = 0;
    const Mat6 scaled = scale.asDiagonal() * k[a] * scale.asDiagonal();
    if (scaled.norm() <= most) continue;  // no eigenvalue is above the Frobenius norm
    most = std::max(most, Eigen::SelfAdjointEigenSolver<Mat6>(scaled, Eigen::EigenvaluesOnly).eigenvalues()[5]);
  }
  return most > 0 ? 2 / std::sqrt(2 * most) : std::numeric_limits<double>::infinity();
}

}  // namespace breccia
