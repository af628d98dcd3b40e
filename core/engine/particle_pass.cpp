// SPDX-License-Identifier: BSD-3-Clause
#include "engine/particle_pass.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/contact.hpp"

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

/// The same for n particles that nothing holds, as one vector loop; vectors are three numbers each.
BRECCIA_VECTOR_CLONES void advance_free(double* v, const double* load, const double* mass, std::size_t n, double alpha, double dt, double* lost) {
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const double vx = v[3 * k], vy = v[3 * k + 1], vz = v[3 * k + 2], fx = load[3 * k], fy = load[3 * k + 1], fz = load[3 * k + 2];
    const double speed2 = vx * vx + (vy * vy + vz * vz), force2 = fx * fx + (fy * fy + fz * fz);
    const bool drags = (alpha > 0) & (speed2 > 0);
    const double share = -alpha * std::sqrt(force2 / (drags ? speed2 : 1.0));
    const double dx = drags ? vx * share : 0.0, dy = drags ? vy * share : 0.0, dz = drags ? vz * share : 0.0;
    const double mobility = dt / mass[k], gx = mobility * (fx + dx), gy = mobility * (fy + dy), gz = mobility * (fz + dz);
    lost[k] = -(dx * (vx + 0.5 * gx) + (dy * (vy + 0.5 * gy) + dz * (vz + 0.5 * gz))) * dt;
    v[3 * k] = vx + gx;
    v[3 * k + 1] = vy + gy;
    v[3 * k + 2] = vz + gz;
  }
}

}  // namespace

void clear_forces(State& s, const Share& share) {
  std::fill(s.particles.force.begin() + share.first_particle, s.particles.force.begin() + share.end_particle, Vec3::Zero());
  std::fill(s.particles.torque.begin() + share.first_particle, s.particles.torque.begin() + share.end_particle, Vec3::Zero());
}

void complete_forces(State& s, const Share& share, const Incidence& in, const std::vector<Vec3>& external_force,
                     const std::vector<Vec3>& external_torque) {
  Particles& p = s.particles;
  const Vec3* moment = s.pairs.moment.empty() ? nullptr : s.pairs.moment.data();
  for (const Index a : share.apart)
    for (std::size_t e = in.start[a]; e < in.start[a + 1]; ++e) {
      const PairForce& q = s.pairs.force[in.entry[e] >> 1];
      const double sign = in.entry[e] & 1 ? -1.0 : 1.0, arm = p.radius[a] + q.half_gap;
      Vec3 torque(arm * q.tx, arm * q.ty, arm * q.tz);
      if (moment) torque += sign * moment[in.entry[e] >> 1];
      p.force[a] += sign * Vec3(q.fx, q.fy, q.fz);
      p.torque[a] += torque;
    }
  for (Index a = share.first_particle; a < share.end_particle; ++a) {
    p.force[a] += external_force[a];
    p.torque[a] += external_torque[a];
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
    const std::size_t first = std::size_t(b) * block, end = std::min(n, first + block);
    std::uint8_t any_held = 0;
    for (std::size_t a = first; a < end; ++a) any_held |= p.held[a];
    if (any_held || any_applied) {
      for (std::size_t a = first; a < end; ++a) {
        const std::uint8_t held = p.held[a];
        const Vec3 before = p.velocity[a];
        sum.damping += advance(p.velocity[a], p.force[a], p.mass[a], damping.translational, held & dof::translation, dt, sum.boundary_work);
        sum.damping += advance(p.angular_velocity[a], p.torque[a], p.inertia[a], damping.rotational, std::uint8_t(held >> 3), dt, sum.boundary_work);
        if (any_applied) sum.boundary_work += p.applied_force[a].dot(before + p.velocity[a]) * 0.5 * dt;
      }
    } else {
      double lost[block], lost_turning[block];
      advance_free(p.velocity[first].data(), p.force[first].data(), p.mass.data() + first, end - first, damping.translational, dt, lost);
      advance_free(p.angular_velocity[first].data(), p.torque[first].data(), p.inertia.data() + first, end - first, damping.rotational, dt, lost_turning);
      for (std::size_t k = 0; k < end - first; ++k) {
        sum.damping += lost[k];
        sum.damping += lost_turning[k];
      }
    }
    double fastest = 0;
    for (std::size_t a = first; a < end; ++a) {
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
