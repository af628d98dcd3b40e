// SPDX-License-Identifier: BSD-3-Clause
#include "engine/particle_pass.hpp"

#include <cmath>

namespace breccia {
namespace {

constexpr std::size_t block = 256;  // grain of the sums: never depends on the thread count

/// Advances one velocity vector; returns the energy that damping took.
double advance(Vec3& v, const Vec3& load, double mass, double alpha, std::uint8_t held, double dt, double& boundary_work) {
  Vec3 free = load;
  if (held) [[unlikely]]
    for (int k = 0; k < 3; ++k)
      if (held >> k & 1) {
        boundary_work -= load[k] * v[k] * dt;  // the hand that holds it opposes the resultant
        free[k] = 0;
      }
  const double speed2 = v.squaredNorm();
  Vec3 drag = Vec3::Zero();
  if (alpha > 0 && speed2 > 0) {
    Vec3 moving = v;
    if (held) [[unlikely]]
      for (int k = 0; k < 3; ++k)
        if (held >> k & 1) moving[k] = 0;
    const double m2 = held ? moving.squaredNorm() : speed2;
    if (m2 > 0) drag = moving * (-alpha * std::sqrt(free.squaredNorm() / m2));
  }
  const Vec3 gain = (dt / mass) * (free + drag);
  const double lost = -drag.dot(v + 0.5 * gain) * dt;
  v += gain;
  return lost;
}

}  // namespace

void sum_forces(State& s, const Incidence& in, const std::vector<Vec3>& external_force, const std::vector<Vec3>& external_torque, int threads) {
  Particles& p = s.particles;
  const PairForce* pair = s.pairs.force.data();
  const Vec3* moment = s.pairs.moment.empty() ? nullptr : s.pairs.moment.data();
  const std::ptrdiff_t n = std::ptrdiff_t(p.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t a = 0; a < n; ++a) {
    const double r = p.radius[a];
    double f[3] = {0, 0, 0}, t[3] = {0, 0, 0};
    for (std::size_t e = in.start[a]; e < in.start[a + 1]; ++e) {
      const PairForce& q = pair[in.entry[e] >> 1];
      const double sign = in.entry[e] & 1 ? -1.0 : 1.0, arm = r + q.half_gap;
      f[0] += sign * q.fx; f[1] += sign * q.fy; f[2] += sign * q.fz;
      t[0] += arm * q.tx; t[1] += arm * q.ty; t[2] += arm * q.tz;
    }
    Vec3 torque(t[0], t[1], t[2]);
    if (moment)
      for (std::size_t e = in.start[a]; e < in.start[a + 1]; ++e)
        torque += (in.entry[e] & 1 ? -1.0 : 1.0) * moment[in.entry[e] >> 1];
    p.force[a] = Vec3(f[0], f[1], f[2]) + external_force[a];
    p.torque[a] = torque + external_torque[a];
  }
}

PassSums integrate(State& s, const Damping& damping, bool any_applied, int threads) {
  Particles& p = s.particles;
  const double dt = s.time_step;
  const std::size_t n = p.size(), blocks = (n + block - 1) / block;
  std::vector<PassSums> sums(blocks);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::ptrdiff_t b = 0; b < std::ptrdiff_t(blocks); ++b) {
    PassSums& sum = sums[b];
    double fastest = 0;
    for (std::size_t a = std::size_t(b) * block; a < std::min(n, std::size_t(b + 1) * block); ++a) {
      const std::uint8_t held = p.held[a];
      const Vec3 before = p.velocity[a];
      sum.damping += advance(p.velocity[a], p.force[a], p.mass[a], damping.translational, held & dof::translation, dt, sum.boundary_work);
      sum.damping += advance(p.angular_velocity[a], p.torque[a], p.inertia[a], damping.rotational, std::uint8_t(held >> 3), dt, sum.boundary_work);
      if (any_applied) sum.boundary_work += p.applied_force[a].dot(before + p.velocity[a]) * 0.5 * dt;
      p.position[a] += dt * p.velocity[a];
      fastest = std::max(fastest, p.velocity[a].squaredNorm());
    }
    sum.largest_speed = std::sqrt(fastest);
  }
  PassSums total;
  for (const PassSums& sum : sums) {
    total.damping += sum.damping;
    total.boundary_work += sum.boundary_work;
    // A speed that is not a number must not be lost in the maximum.
    if (!(sum.largest_speed <= total.largest_speed)) total.largest_speed = sum.largest_speed;
  }
  return total;
}

double kinetic_energy(const State& s) {
  const Particles& p = s.particles;
  double sum = 0;
  for (std::size_t a = 0; a < p.size(); ++a) {
    sum += p.mass[a] * p.velocity[a].squaredNorm() + p.inertia[a] * p.angular_velocity[a].squaredNorm();
    for (int k = 0; k < 3; ++k) {
      if (!(p.held[a] >> k & 1)) sum += s.time_step * p.velocity[a][k] * p.force[a][k];
      if (!(p.held[a] >> (k + 3) & 1)) sum += s.time_step * p.angular_velocity[a][k] * p.torque[a][k];
    }
  }
  return 0.5 * sum;
}

}  // namespace breccia
