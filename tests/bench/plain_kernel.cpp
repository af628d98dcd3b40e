// SPDX-License-Identifier: BSD-3-Clause
#include "plain_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "breccia/contact.hpp"

namespace breccia {
namespace {

struct PlainEnergy {
  double friction, fracture;  // in this step [J]
};

/// Some pairs side by side, of which the compiler makes vectors. As one loop over the pairs that gathers as it goes the
/// kernel takes 1.7 times as long, with the processor's gathers 2.1 times: it would be too easy to beat.
struct alignas(64) Strip {
  static constexpr std::size_t length = 64;
  double dx[length], dy[length], dz[length], vx[length], vy[length], vz[length];  // [m], [m/s]
  double wax[length], way[length], waz[length], wbx[length], wby[length], wbz[length], ra[length], rb[length],
      intact[length];
  double fx[length], fy[length], fz[length], tx[length], ty[length], tz[length], half_gap[length], broke[length];
};

BRECCIA_KERNEL void gather(const PlainParticle& a, const PlainParticle& b, Strip& g, std::size_t l) {
  g.dx[l] = b.x[0] - a.x[0];
  g.dy[l] = b.x[1] - a.x[1];
  g.dz[l] = b.x[2] - a.x[2];
  g.vx[l] = b.v[0] - a.v[0];
  g.vy[l] = b.v[1] - a.v[1];
  g.vz[l] = b.v[2] - a.v[2];
  g.wax[l] = a.w[0];
  g.way[l] = a.w[1];
  g.waz[l] = a.w[2];
  g.wbx[l] = b.w[0];
  g.wby[l] = b.w[1];
  g.wbz[l] = b.w[2];
  g.ra[l] = a.radius;
  g.rb[l] = b.radius;
}

/// Pair by pair: the relative motion in this step at the contact point, measured in the middle of the step where the
/// velocities belong, moves the shear spring; the spring follows the plane of contact and the mean spin about the
/// normal.
BRECCIA_VECTOR_CLONES PlainEnergy pair_forces(const PlainParticle* particles, PlainPairs& pairs, const PlainLaw law,
                                              double dt) {
  const std::size_t n = pairs.i.size();
  const std::uint32_t* __restrict first = pairs.i.data(), * __restrict second = pairs.j.data();
  const double* __restrict rest_length = pairs.rest.data();
  double *__restrict spring_x = pairs.spring_x.data(), *__restrict spring_y = pairs.spring_y.data(),
                     *__restrict spring_z = pairs.spring_z.data();
  std::uint8_t* __restrict state = pairs.state.data();
  PlainForce* __restrict out = pairs.force.data();
  double friction = 0, fracture = 0;
  Strip g;
  for (std::size_t start = 0; start < n; start += Strip::length) {
    const std::size_t count = std::min(Strip::length, n - start);
    for (std::size_t l = 0; l < count; ++l) gather(particles[first[start + l]], particles[second[start + l]], g, l);
    for (std::size_t l = 0; l < count; ++l) g.intact[l] = state[start + l] == 1;
#pragma omp simd reduction(+ : friction, fracture)
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t k = start + l;
      const double dx = g.dx[l], dy = g.dy[l], dz = g.dz[l], vx = g.vx[l], vy = g.vy[l], vz = g.vz[l];
      const double wax = g.wax[l], way = g.way[l], waz = g.waz[l], wbx = g.wbx[l], wby = g.wby[l], wbz = g.wbz[l];
      const double d = std::sqrt(dx * dx + dy * dy + dz * dz), over = 1 / d;
      const double nx = dx * over, ny = dy * over, nz = dz * over;

      // The normal in the middle of the step.
      const double opening = vx * nx + vy * ny + vz * nz;
      const double px = vx - opening * nx, py = vy - opening * ny, pz = vz - opening * nz;
      const double half_turn = 0.5 * dt * over, bend = half_turn * half_turn * (px * px + py * py + pz * pz);
      const double shrink = 1 - 0.5 * bend;
      const double mx = shrink * (nx - half_turn * px), my = shrink * (ny - half_turn * py),
                   mz = shrink * (nz - half_turn * pz);

      // Motion at the contact point.
      const double ra = g.ra[l], rb = g.rb[l], middle_gap = 0.5 * (d - 0.5 * dt * opening - ra - rb);
      const double la = ra + middle_gap, lb = rb + middle_gap;
      const double rx = la * wax + lb * wbx, ry = la * way + lb * wby, rz = la * waz + lb * wbz;
      const double along = vx * mx + vy * my + vz * mz;
      const double sx = dt * (vx - along * mx - (ry * mz - rz * my)), sy = dt * (vy - along * my - (rz * mx - rx * mz)),
                   sz = dt * (vz - along * mz - (rx * my - ry * mx));
      const double spin = 0.5 * dt * ((wax + wbx) * mx + (way + wby) * my + (waz + wbz) * mz);
      const double lift = sx * nx + sy * ny + sz * nz, half = 0.5 * spin;
      const double fx = sx - lift * nx, fy = sy - lift * ny, fz = sz - lift * nz;

      // The spring of before: mirrored at the middle plane and at the new one, turned about the normal.
      double qx = spring_x[k], qy = spring_y[k], qz = spring_z[k];
      const double mirror = 2 * (qx * mx + qy * my + qz * mz);
      qx -= mirror * mx, qy -= mirror * my, qz -= mirror * mz;
      const double out_of_plane = qx * nx + qy * ny + qz * nz;
      qx -= out_of_plane * nx, qy -= out_of_plane * ny, qz -= out_of_plane * nz;
      const double cosine = 1 - 0.5 * spin * spin;
      const double ox = cosine * qx + spin * (ny * qz - nz * qy), oy = cosine * qy + spin * (nz * qx - nx * qz),
                   oz = cosine * qz + spin * (nx * qy - ny * qx);
      const double ux = ox + fx + half * (ny * fz - nz * fy), uy = oy + fy + half * (nz * fx - nx * fz),
                   uz = oz + fz + half * (nx * fy - ny * fx);

      // The law.
      const double mean = 0.5 * (ra + rb), kn = 2 * law.bond_modulus * mean, ks = kn / law.stiffness_ratio;
      const double area = 4 * mean * mean, normal = kn * (d - rest_length[k]);
      const double length = std::sqrt(ux * ux + uy * uy + uz * uz), shear = ks * length;
      const bool was = g.intact[l] > 0, torn = was & (normal >= law.tensile_strength * area),
                 sheared = was & !torn & (shear >= law.shear_strength * area), holds = was & !torn & !sheared;
      const double pressed = normal < 0 ? normal : 0.0, limit = -law.friction * pressed;
      const bool slides = !holds & (shear > limit);
      const double keep = slides ? limit / (shear > 0 ? shear : 1.0) : 1.0;
      spring_x[k] = keep * ux, spring_y[k] = keep * uy, spring_z[k] = keep * uz;

      const double tx = ks * keep * ux, ty = ks * keep * uy, tz = ks * keep * uz, push = holds ? normal : pressed;
      g.fx[l] = push * nx + tx, g.fy[l] = push * ny + ty, g.fz[l] = push * nz + tz;
      g.tx[l] = ny * tz - nz * ty, g.ty[l] = nz * tx - nx * tz, g.tz[l] = nx * ty - ny * tx;
      g.half_gap[l] = 0.5 * (d - ra - rb);
      g.broke[l] = torn ? 2.0 : sheared ? 3.0 : 0.0;
      const bool broke = torn | sheared;
      const double along_old = ox * ux + oy * uy + oz * uz;
      const double slid = slides ? 0.5 * (ks * along_old + limit * length) * (1 - keep) : 0.0;
      const double lost = normal - pressed;  // it was not there for the second half of the step
      friction += broke ? 0.0 : slid;
      fracture += broke ? slid + 0.5 * lost * (d - rest_length[k] - dt * opening) : 0.0;
    }
    for (std::size_t l = 0; l < count; ++l) {
      out[start + l] = {{g.fx[l], g.fy[l], g.fz[l]}, {g.tx[l], g.ty[l], g.tz[l]}, g.half_gap[l], 0};
      if (g.broke[l] > 0) state[start + l] = std::uint8_t(g.broke[l]);
    }
  }
  return {friction, fracture};
}

/// One velocity vector with non-viscous damping; yields what damping took.
BRECCIA_KERNEL double accelerate(double* v, const double* load, double mass, double alpha, double dt) {
  const double speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2],
               load2 = load[0] * load[0] + load[1] * load[1] + load[2] * load[2];
  const double share = (alpha > 0) & (speed2 > 0) ? alpha * std::sqrt(load2 / speed2) : 0.0;
  double lost = 0;
  for (int c = 0; c < 3; ++c) {
    const double drag = share * v[c], gain = dt / mass * (load[c] - drag);
    lost += drag * (v[c] + 0.5 * gain) * dt;
    v[c] += gain;
  }
  return lost;
}

}  // namespace

PlainKernel::PlainKernel(const State& start, const PlainLaw& law, const Damping& damping)
    : law_(law), damping_(damping), dt_(start.time_step) {
  const Particles& p = start.particles;
  for (std::size_t a = 0; a < p.size(); ++a) {
    const Vec3 &x = p.position()[a], &v = p.velocity()[a], &w = p.angular_velocity()[a];
    particles_.push_back(
        {{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}, p.radius()[a], p.mass()[a], p.inertia()[a]});
  }
  force_.resize(3 * p.size());
  const Pairs& q = start.pairs;
  const std::size_t n = q.size();
  pairs_.i = q.i;
  pairs_.j = q.j;
  pairs_.rest = q.rest_length;
  for (auto* column : {&pairs_.spring_x, &pairs_.spring_y, &pairs_.spring_z}) column->assign(n, 0);
  for (const BondState state : q.state) pairs_.state.push_back(std::uint8_t(state));
  pairs_.force.resize(n);
  first_.assign(p.size() + 1, 0);
  for (std::size_t k = 0; k < n; ++k) {
    ++first_[q.i[k] + 1];
    ++first_[q.j[k] + 1];
  }
  for (std::size_t a = 0; a < p.size(); ++a) first_[a + 1] += first_[a];
  entry_.resize(2 * n);
  std::vector<std::uint32_t> next = first_;
  for (std::size_t k = 0; k < n; ++k) {
    entry_[next[q.i[k]]++] = std::uint32_t(2 * k);
    entry_[next[q.j[k]]++] = std::uint32_t(2 * k + 1);
  }
}

void PlainKernel::step() {
  const PlainEnergy dissipated = pair_forces(particles_.data(), pairs_, law_, dt_);
  friction_ += dissipated.friction;
  fracture_ += dissipated.fracture;
  for (std::size_t a = 0; a < particles_.size(); ++a) {
    PlainParticle& p = particles_[a];
    double force[3] = {}, torque[3] = {};
    for (std::uint32_t e = first_[a]; e < first_[a + 1]; ++e) {
      const PlainForce& f = pairs_.force[entry_[e] / 2];
      const double sign = entry_[e] % 2 ? -1.0 : 1.0, arm = p.radius + f.half_gap;
      for (int c = 0; c < 3; ++c) {
        force[c] += sign * f.force[c];
        torque[c] += arm * f.torque_per_arm[c];
      }
    }
    for (int c = 0; c < 3; ++c) force_[3 * a + std::size_t(c)] = force[c];
    damped_ += accelerate(p.v, force, p.mass, damping_.translational, dt_);
    damped_ += accelerate(p.w, torque, p.inertia, damping_.rotational, dt_);
    for (int c = 0; c < 3; ++c) p.x[c] += dt_ * p.v[c];
  }
}

}  // namespace breccia
