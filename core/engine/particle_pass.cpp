// SPDX-License-Identifier: BSD-3-Clause
#include "engine/particle_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "breccia/contact.hpp"
#include "engine/four.hpp"

namespace breccia {
namespace {

constexpr std::size_t block = particle_block;

/// Velocities and what drives them of a few particles, as arrays.
struct alignas(64) Drive {
  static constexpr std::size_t n = 64;
  double vx[n], vy[n], vz[n], lx[n], ly[n], lz[n], inertia[n];
};

/// Of each particle of a block, in this step: the energy that damping took, and the work of the hands that hold [J].
struct Losses {
  double damped[block], held[block];
};

/// One member of each of n records, turned into arrays, and back.
template <class Record>
BRECCIA_KERNEL void turn_in(const Record* of, Vec3 Record::*member, std::size_t n, double* x, double* y, double* z) {
  for (std::size_t k = 0; k < n; k += 4) {
    const auto at = [&](std::size_t l) __attribute__((always_inline))->const Vec3& {
      return of[std::min(k + l, n - 1)].*member;
    };
    Four row[4] = {four(at(0)), four(at(1)), four(at(2)), four(at(3))};
    transpose(row[0], row[1], row[2], row[3]);
    four(x + k) = row[0];
    four(y + k) = row[1];
    four(z + k) = row[2];
  }
}
BRECCIA_KERNEL void turn_back(ParticleMotion* of, Vec3 ParticleMotion::*member, double ParticleMotion::*behind,
                              std::size_t n, const double* x, const double* y, const double* z) {
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    Four a = four(x + k), b = four(y + k), c = four(z + k),
         d = {of[k].*behind, of[k + 1].*behind, of[k + 2].*behind, of[k + 3].*behind};
    transpose(a, b, c, d);
    four(of[k].*member) = a;
    four(of[k + 1].*member) = b;
    four(of[k + 2].*member) = c;
    four(of[k + 3].*member) = d;
  }
  for (; k < n; ++k) of[k].*member = Vec3(x[k], y[k], z[k]);
}

/// Where nothing drives it, damping takes a particle's velocity towards zero without end. Below 1e-100 m/s (or 1/s) it
/// is at rest: the square of less, under that of a force, would be no finite number when the particle is hit.
constexpr double at_rest = 1e-200;

/// Advances n velocities as one vector loop. Bits 0 to 2 of held >> shift: components that keep their velocity.
BRECCIA_KERNEL void advance(Drive& d, const std::uint8_t* held, int shift, std::size_t n, double alpha, double dt,
                            double* lost, double* work) {
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const int bits = held[k] >> shift;
    const double ox = bits & 1 ? 0.0 : 1.0, oy = bits & 2 ? 0.0 : 1.0, oz = bits & 4 ? 0.0 : 1.0;
    const double vx = d.vx[k], vy = d.vy[k], vz = d.vz[k], lx = d.lx[k], ly = d.ly[k], lz = d.lz[k];
    const double fx = ox * lx, fy = oy * ly, fz = oz * lz, ux = ox * vx, uy = oy * vy, uz = oz * vz;
    const double speed2 = ux * ux + (uy * uy + uz * uz), force2 = fx * fx + (fy * fy + fz * fz);
    const bool drags = (alpha > 0) & (speed2 > at_rest);
    const double share = -alpha * std::sqrt(force2 / (drags ? speed2 : 1.0));
    const double dx = drags ? ux * share : 0.0, dy = drags ? uy * share : 0.0, dz = drags ? uz * share : 0.0;
    const double mobility = dt / d.inertia[k], gx = mobility * (fx + dx), gy = mobility * (fy + dy),
                 gz = mobility * (fz + dz);
    lost[k] = -(dx * (vx + 0.5 * gx) + (dy * (vy + 0.5 * gy) + dz * (vz + 0.5 * gz))) * dt;
    work[k] = -((lx - fx) * vx + ((ly - fy) * vy + (lz - fz) * vz)) * dt;  // they oppose the resultant
    d.vx[k] = vx + gx;
    d.vy[k] = vy + gy;
    d.vz[k] = vz + gz;
  }
}

/// Of n particles one kind of velocity: which member it is and what stands behind it in its record, what drives it,
/// what resists, and where its bits of `held` are.
template <Vec3 ParticleMotion::*velocity, double ParticleMotion::*behind, Vec3 ParticleLoad::*drive,
          double ParticleMotion::*inertia, int shift>
BRECCIA_KERNEL void advance_all(ParticleMotion* m, const ParticleLoad* load, const std::uint8_t* held, std::size_t n,
                                double alpha, double dt, Losses& out) {
  Drive d;
  for (std::size_t first = 0, some; first < n; first += some) {
    some = std::min(Drive::n, n - first);
    turn_in(m + first, velocity, some, d.vx, d.vy, d.vz);
    turn_in(load + first, drive, some, d.lx, d.ly, d.lz);
    for (std::size_t k = 0; k < some; ++k) d.inertia[k] = m[first + k].*inertia;
    advance(d, held + first, shift, some, alpha, dt, out.damped + first, out.held + first);
    turn_back(m + first, velocity, behind, some, d.vx, d.vy, d.vz);
  }
}

BRECCIA_VECTOR_CLONES void advance_velocities(ParticleMotion* m, const ParticleLoad* load, const std::uint8_t* held,
                                              std::size_t n, double alpha, double dt, Losses& out) {
  using M = ParticleMotion;
  advance_all<&M::velocity, &M::inertia, &ParticleLoad::force, &M::mass, 0>(m, load, held, n, alpha, dt, out);
}

BRECCIA_VECTOR_CLONES void advance_spins(ParticleMotion* m, const ParticleLoad* load, const std::uint8_t* held,
                                         std::size_t n, double alpha, double dt, Losses& out) {
  using M = ParticleMotion;
  advance_all<&M::angular_velocity, &M::radius, &ParticleLoad::torque, &M::inertia, 3>(m, load, held, n, alpha, dt,
                                                                                       out);
}

/// Positions by a step of `dt`; what stands behind them stays.
BRECCIA_VECTOR_CLONES void advance_positions(ParticleMotion* m, std::size_t n, double dt) {
  const Four step = {dt, dt, dt, 0};
  for (std::size_t k = 0; k < n; ++k) four(m[k].position) += step * four(m[k].velocity);
}

/// What applied forces and torques do in half a step at the present velocities [J].
double half_applied_work(const Particles& p, std::size_t first, std::size_t end, double dt) {
  double sum = 0;
  if (!p.applied_force.empty())
    for (std::size_t a = first; a < end; ++a) sum += p.applied_force[a].dot(p.velocity()[a]);
  if (!p.applied_torque.empty())
    for (std::size_t a = first; a < end; ++a) sum += p.applied_torque[a].dot(p.angular_velocity()[a]);
  return 0.5 * dt * sum;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Infinite if a velocity or a spin is not a finite number, which the maximum would pass over.
double largest_speed(const Particles& p, std::size_t first, std::size_t end) {
  double fastest = 0;
  bool finite = true;
  for (std::size_t a = first; a < end; ++a) {
    const double speed2 = p.velocity()[a].squaredNorm();
    fastest = std::max(fastest, speed2);
    finite &= (speed2 < infinity) & (p.angular_velocity()[a].squaredNorm() < infinity);
  }
  return finite ? std::sqrt(fastest) : infinity;
}

}  // namespace

void clear_forces(State& s, const Share& share) {
  std::fill(s.particles.load.begin() + share.first_particle, s.particles.load.begin() + share.end_particle,
            ParticleLoad{});
}

void complete_forces(State& s, const Share& share, const Partition& partition, const Incidence& in,
                     const ExternalLoads& loads) {
  Particles& p = s.particles;
  const bool moments = !s.pairs.moment.empty();
  const auto add_load = [&](Index a) {
    if (const auto* const load = loads.of(a)) {
      p.force()[a] += load->force;
      p.torque()[a] += load->torque;
    }
  };
  std::size_t row = 0;
  for (const Index a : share.apart) {
    if (!p.own(a)) {
      row += in.start[a + 1] - in.start[a];
      continue;
    }
    for (std::size_t e = in.start[a]; e < in.start[a + 1]; ++e) {
      const CutForce& q = partition.cut[share.cut[row++]];
      const double sign = in.entry[e] & 1 ? -1.0 : 1.0, arm = p.radius()[a] + q.half_gap;
      Vec3 torque(arm * q.tx, arm * q.ty, arm * q.tz);
      if (moments) torque += sign * Vec3(q.mx, q.my, q.mz);
      p.force()[a] += sign * Vec3(q.fx, q.fy, q.fz);
      p.torque()[a] += torque;
    }
    add_load(a);
  }
  const std::size_t last = std::min<std::size_t>(share.end_particle, p.end_own());
  for (std::size_t first = std::max<std::size_t>(share.first_particle, p.first_own()), end; first < last; first = end) {
    end = std::min(last, loads.end_of_group(first));
    if (!loads.of(first)) continue;
    for (std::size_t a = first; a < end; ++a)
      if (!partition.apart[a]) add_load(Index(a));
  }
}

/// The velocities of particles [first, end) as seen from the strained space, for as long as this lives: less its motion
/// in the half step behind, and in the end with that of the half step ahead. Where the two differ the particles have
/// been pushed, each by what goes with its place.
class SeenFromCell {
 public:
  SeenFromCell(Particles& p, const CellMotion& motion, std::size_t first, std::size_t end)
      : p_(p), first_(first), end_(end) {
    for (std::size_t a = first_; a < end_; ++a) {
      const Vec3 from = p.position()[a] - motion.centre;
      Vec3 behind = motion.before * from;
      Vec3& ahead = ahead_[a - first_] = motion.after * from;
      for (int k = 0; k < 3; ++k)
        if (p.held[a] >> k & 1) behind[k] = ahead[k] = 0;
      push_[a - first_] = ahead - behind;
      before_[a - first_] = p.velocity()[a] -= behind;
    }
  }
  SeenFromCell(const SeenFromCell&) = delete;
  SeenFromCell& operator=(const SeenFromCell&) = delete;
  ~SeenFromCell() {
    for (std::size_t a = first_; a < end_; ++a) p_.velocity()[a] += ahead_[a - first_];
  }
  /// Of the pushes, as of whoever leads a particle: its energy, and half a step at the old velocity [J].
  double push_work(double dt) const {
    double sum = 0;
    for (std::size_t a = first_; a < end_; ++a) {
      const Vec3& push = push_[a - first_];
      const Vec3 middle = before_[a - first_] + ahead_[a - first_] - 0.5 * push;
      sum += p_.mass()[a] * push.dot(middle) + 0.5 * dt * p_.force()[a].dot(push);
    }
    return sum;
  }
  /// What the damping took from the space's motion, after the velocities were advanced by `dt` [J].
  double damped(double dt) const {
    double sum = 0;
    for (std::size_t a = first_; a < end_; ++a) {
      const Vec3 gained = p_.mass()[a] * (p_.velocity()[a] - before_[a - first_]) - dt * p_.force()[a];
      sum -= gained.dot(ahead_[a - first_]);
    }
    return sum;
  }

 private:
  Particles& p_;
  std::size_t first_, end_;
  Vec3 ahead_[block], push_[block], before_[block];
};

double integrate(State& s, const Damping& damping, const CellMotion& cell, bool any_applied, int threads,
                 std::span<BlockAccount> accounts) {
  Particles& p = s.particles;
  const double dt = s.time_step;
  const std::size_t blocks = blocks_of(p);
  BRECCIA_ASSERT(accounts.size() == blocks);
  double fastest = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : fastest)
  for (std::ptrdiff_t b = 0; b < std::ptrdiff_t(blocks); ++b) {
    BlockAccount& sum = accounts[std::size_t(b)];
    const std::size_t first = p.first_own() + std::size_t(b) * block, end = std::min(p.end_own(), first + block);
    double speed = 0;
    Losses moving, turning;
    if (any_applied) sum.boundary_work += half_applied_work(p, first, end, dt);
    {
      std::optional<SeenFromCell> seen;
      if (cell.any()) {
        seen.emplace(p, cell, first, end);
        sum.boundary_work += seen->push_work(dt);
      }
      advance_velocities(&p.motion[first], &p.load[first], &p.held[first], end - first, damping.translational, dt,
                         moving);
      if (seen) sum.damping += seen->damped(dt);
      advance_spins(&p.motion[first], &p.load[first], &p.held[first], end - first, damping.rotational, dt, turning);
      speed = largest_speed(p, first, end);
    }
    if (any_applied) sum.boundary_work += half_applied_work(p, first, end, dt);
    for (std::size_t k = 0; k < end - first; ++k) {
      sum.damping += moving.damped[k] + turning.damped[k];
      sum.boundary_work += moving.held[k] + turning.held[k];
    }
    fastest = std::max(fastest, speed);
    if (speed < infinity) advance_positions(&p.motion[first], end - first, dt);
  }
  return fastest;
}

void undo_positions(State& s) {
  Particles& p = s.particles;
  for (std::size_t first = p.first_own(); first < p.end_own(); first += block) {
    const std::size_t end = std::min(p.end_own(), first + block);
    if (largest_speed(p, first, end) < infinity) advance_positions(&p.motion[first], end - first, -s.time_step);
  }
}

void add_led_work_behind(const State& s, ExactSum& to) {
  const Particles& p = s.particles;
  add_block_by_block(p, to, [&](std::size_t a) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      if (p.held[a] >> k & 1) sum -= p.force()[a][k] * p.velocity()[a][k];
      if (p.held[a] >> (k + 3) & 1) sum -= p.torque()[a][k] * p.angular_velocity()[a][k];
    }
    return 0.5 * s.time_step * sum;
  });
}

void add_kinetic_energy(const State& s, ExactSum& to) {
  const Particles& p = s.particles;
  add_block_by_block(p, to, [&](std::size_t a) {
    double sum = p.mass()[a] * p.velocity()[a].squaredNorm() + p.inertia()[a] * p.angular_velocity()[a].squaredNorm();
    for (int k = 0; k < 3; ++k) {
      if (!(p.held[a] >> k & 1)) sum += s.time_step * p.velocity()[a][k] * p.force()[a][k];
      if (!(p.held[a] >> (k + 3) & 1)) sum += s.time_step * p.angular_velocity()[a][k] * p.torque()[a][k];
    }
    return 0.5 * sum;
  });
}

}  // namespace breccia
