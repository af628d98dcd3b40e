// SPDX-License-Identifier: BSD-3-Clause
/// The loop over pairs, instantiated inside each law's plugin: gathers a chunk into local arrays, runs the law over
/// them as one vector loop, writes the history back and adds the forces to their particles.
#pragma once

#include <algorithm>
#include <bit>
#include <type_traits>
#include <utility>

#include "breccia/contact.hpp"

namespace breccia {

namespace detail {

// The member pointer must be a constant for the compiler's front end: read at run time from the table it would take the
// State's address, keep it in memory and stop the loop from vectorising. An aggregate initialiser would do the same.
template <class Law, std::size_t K>
BRECCIA_KERNEL double& column_of(typename Law::State& s) {
  constexpr auto member = Law::columns[K].member;
  return s.*member;
}
template <class Law, std::size_t... K>
BRECCIA_KERNEL void load_state(typename Law::State& s, double* const* h, std::size_t k, std::index_sequence<K...>) {
  ((column_of<Law, K>(s) = h[K][k]), ...);
}
template <class Law, std::size_t... K>
BRECCIA_KERNEL void store_state(typename Law::State& s, double* const* h, std::size_t k, std::index_sequence<K...>) {
  ((h[K][k] = column_of<Law, K>(s)), ...);
}
/// The history of one chunk after the step.
template <class Law>
struct alignas(64) NewState {
  double column[Law::columns.size() + 1][PairBatch::chunk];
};
template <class Law, std::size_t... K>
BRECCIA_KERNEL void store_state(typename Law::State& s, NewState<Law>& h, std::size_t k, std::index_sequence<K...>) {
  ((h.column[K][k] = column_of<Law, K>(s)), ...);
}

/// One chunk of gathered pairs: structure of arrays, so that the law vectorises over it.
struct alignas(64) Gathered {
  static constexpr std::size_t n = PairBatch::chunk;
  double dx[n], dy[n], dz[n], vx[n], vy[n], vz[n];
  double wix[n], wiy[n], wiz[n], wjx[n], wjy[n], wjz[n];
  double ri[n], rj[n], mi[n], mj[n], intact[n], breakable[n];
};

template <bool with_mass, bool guarded>
BRECCIA_KERNEL void gather(const PairBatch& b, std::size_t first, std::size_t n, Gathered& g) {
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = b.i[first + k], j = b.j[first + k];
    const double *xi = b.position[i].data(), *xj = b.position[j].data();
    const double *vi = b.velocity[i].data(), *vj = b.velocity[j].data();
    const double *wi = b.angular_velocity[i].data(), *wj = b.angular_velocity[j].data();
    g.dx[k] = xj[0] - xi[0];
    g.dy[k] = xj[1] - xi[1];
    g.dz[k] = xj[2] - xi[2];
    g.vx[k] = vj[0] - vi[0];
    g.vy[k] = vj[1] - vi[1];
    g.vz[k] = vj[2] - vi[2];
    g.wix[k] = wi[0];
    g.wiy[k] = wi[1];
    g.wiz[k] = wi[2];
    g.wjx[k] = wj[0];
    g.wjy[k] = wj[1];
    g.wjz[k] = wj[2];
    g.ri[k] = b.radius[i];
    g.rj[k] = b.radius[j];
    if constexpr (with_mass) {
      g.mi[k] = b.mass[i];
      g.mj[k] = b.mass[j];
    }
    g.intact[k] = b.state[first + k] == BondState::intact ? 1.0 : 0.0;
  }
  if constexpr (guarded)
    for (std::size_t k = 0; k < n; ++k) g.breakable[k] = b.guarded[first + k] ? 0.0 : g.intact[k];
}

/// Coincident centres have no normal: the floor on the distance keeps the result finite (and the force zero).
template <bool with_mass, bool guarded>
BRECCIA_KERNEL Contact contact_of(const Gathered& g, std::size_t k, double rest_length, double dt) {
  const double d = std::sqrt(g.dx[k] * g.dx[k] + g.dy[k] * g.dy[k] + g.dz[k] * g.dz[k]);
  const double inverse = 1.0 / (d > 1e-300 ? d : 1e-300);
  Contact c;
  c.distance = d;
  c.rest_length = rest_length;
  c.radius_i = g.ri[k];
  c.radius_j = g.rj[k];
  c.nx = g.dx[k] * inverse;
  c.ny = g.dy[k] * inverse;
  c.nz = g.dz[k] * inverse;
  c.normal_velocity = g.vx[k] * c.nx + g.vy[k] * c.ny + g.vz[k] * c.nz;
  // The velocities belong to the middle of the step, and what they move is measured with the normal of that moment:
  // with the one of its end the springs would be of first order only.
  const double tx = g.vx[k] - c.normal_velocity * c.nx, ty = g.vy[k] - c.normal_velocity * c.ny,
               tz = g.vz[k] - c.normal_velocity * c.nz;
  const double back2 = 0.25 * dt * dt * inverse * inverse * (tx * tx + ty * ty + tz * tz);
  const double back = back2 < 0.1 ? 0.5 * dt * inverse : 0.0;  // faster than half a radian in a step: no middle
  const double unit = 1 - 0.5 * (back2 < 0.1 ? back2 : 0.0);
  c.mid_x = unit * (c.nx - back * tx);
  c.mid_y = unit * (c.ny - back * ty);
  c.mid_z = unit * (c.nz - back * tz);
  // Velocity of j relative to i at the contact point: v_j - v_i - (a_i w_i + a_j w_j) x n, with lever arms a.
  const double half_gap = 0.5 * (d - 0.5 * dt * c.normal_velocity - g.ri[k] - g.rj[k]);
  const double ai = g.ri[k] + half_gap, aj = g.rj[k] + half_gap;
  const double px = ai * g.wix[k] + aj * g.wjx[k], py = ai * g.wiy[k] + aj * g.wjy[k],
               pz = ai * g.wiz[k] + aj * g.wjz[k];
  const double along = g.vx[k] * c.mid_x + g.vy[k] * c.mid_y + g.vz[k] * c.mid_z;
  const double sx = dt * (g.vx[k] - along * c.mid_x - (py * c.mid_z - pz * c.mid_y));
  const double sy = dt * (g.vy[k] - along * c.mid_y - (pz * c.mid_x - px * c.mid_z));
  const double sz = dt * (g.vz[k] - along * c.mid_z - (px * c.mid_y - py * c.mid_x));
  c.spin =
      0.5 * dt * ((g.wix[k] + g.wjx[k]) * c.mid_x + (g.wiy[k] + g.wjy[k]) * c.mid_y + (g.wiz[k] + g.wjz[k]) * c.mid_z);
  // Half a step on, to the present plane, and with half the spin.
  const double half = 0.5 * c.spin, lifted = sx * c.nx + sy * c.ny + sz * c.nz;
  const double ux = sx - lifted * c.nx, uy = sy - lifted * c.ny, uz = sz - lifted * c.nz;
  c.shear_x = ux + half * (c.ny * uz - c.nz * uy);
  c.shear_y = uy + half * (c.nz * ux - c.nx * uz);
  c.shear_z = uz + half * (c.nx * uy - c.ny * ux);
  const double rx = dt * (g.wjx[k] - g.wix[k]), ry = dt * (g.wjy[k] - g.wiy[k]), rz = dt * (g.wjz[k] - g.wiz[k]);
  const double twist = rx * c.mid_x + ry * c.mid_y + rz * c.mid_z, tilt = rx * c.nx + ry * c.ny + rz * c.nz;
  c.turn_x = rx + (twist * c.nx - tilt * c.mid_x) + half * (c.ny * rz - c.nz * ry);
  c.turn_y = ry + (twist * c.ny - tilt * c.mid_y) + half * (c.nz * rx - c.nx * rz);
  c.turn_z = rz + (twist * c.nz - tilt * c.mid_z) + half * (c.nx * ry - c.ny * rx);
  c.intact = g.intact[k];
  c.breakable = guarded ? g.breakable[k] : g.intact[k];
  if constexpr (with_mass) c.reduced_mass = g.mi[k] * g.mj[k] / (g.mi[k] + g.mj[k]);
  else c.reduced_mass = 0;
  c.time_step = dt;
  return c;
}

template <class Law>
constexpr bool law_has_moments() {
  if constexpr (requires { Law::has_moments; }) return Law::has_moments;
  else return false;
}
template <class Law>
constexpr bool law_respects_protection() {
  if constexpr (requires { Law::respects_protection; }) return Law::respects_protection;
  else return false;
}
template <class Law>
constexpr bool law_needs_mass() {
  if constexpr (requires { Law::needs_mass; }) return Law::needs_mass;
  else return false;
}

/// What one chunk yields, before it is scattered: forces and moments on i, torques on either.
struct alignas(64) Evaluated {
  static constexpr std::size_t n = PairBatch::chunk;
  double fx[n], fy[n], fz[n], tx[n], ty[n], tz[n], mx[n], my[n], mz[n], half_gap[n], breaks[n];
  double tix[n], tiy[n], tiz[n], tjx[n], tjy[n], tjz[n];
  double friction[n], contact[n], fracture[n];
};

/// One lane of the vector loop. A function of its own: aggregates declared in an `omp simd` body stay in memory, those
/// of an inlined function become registers (a factor of three).
template <class Law, bool guarded>
BRECCIA_KERNEL void evaluate_lane(const Law& law, const Gathered& g, double* const* h, NewState<Law>& next, double rest,
                                  double dt, std::size_t k, Evaluated& out) {
  constexpr auto all = std::make_index_sequence<Law::columns.size()>{};
  const Contact c = contact_of<law_needs_mass<Law>(), guarded>(g, k, rest, dt);
  typename Law::State s;
  load_state<Law>(s, h, k, all);
  const ContactForce f = law(c, s);
  store_state<Law>(s, next, k, all);
  out.fx[k] = f.normal * c.nx + f.shear_x;
  out.fy[k] = f.normal * c.ny + f.shear_y;
  out.fz[k] = f.normal * c.nz + f.shear_z;
  const double tx = c.ny * f.shear_z - c.nz * f.shear_y, ty = c.nz * f.shear_x - c.nx * f.shear_z,
               tz = c.nx * f.shear_y - c.ny * f.shear_x;
  const double half_gap = 0.5 * (c.distance - c.radius_i - c.radius_j), ai = c.radius_i + half_gap,
               aj = c.radius_j + half_gap;
  out.tx[k] = tx;
  out.ty[k] = ty;
  out.tz[k] = tz;
  out.tix[k] = ai * tx;
  out.tiy[k] = ai * ty;
  out.tiz[k] = ai * tz;
  out.tjx[k] = aj * tx;
  out.tjy[k] = aj * ty;
  out.tjz[k] = aj * tz;
  if constexpr (law_has_moments<Law>()) {
    out.mx[k] = f.moment_x;
    out.my[k] = f.moment_y;
    out.mz[k] = f.moment_z;
    out.tix[k] += f.moment_x;
    out.tiy[k] += f.moment_y;
    out.tiz[k] += f.moment_z;
    out.tjx[k] -= f.moment_x;
    out.tjy[k] -= f.moment_y;
    out.tjz[k] -= f.moment_z;
  }
  out.half_gap[k] = half_gap;
  out.breaks[k] = f.breaks;
  out.friction[k] = f.friction_work;
  out.contact[k] = f.contact_work;
  out.fracture[k] = f.fracture_energy;
}

/// Writes back the columns that a step has changed. Most are still for most of the time, and memory that is only read
/// costs half as much.
template <class Law>
BRECCIA_KERNEL void write_back(const NewState<Law>& next, double* const* h, std::size_t n) {
  for (std::size_t c = 0; c < Law::columns.size(); ++c) {
    const double* from = next.column[c];
    double* to = h[c];
    std::uint64_t differs = 0;
    for (std::size_t k = 0; k < n; ++k)
      differs |= std::bit_cast<std::uint64_t>(from[k]) ^ std::bit_cast<std::uint64_t>(to[k]);
    if (differs)
      for (std::size_t k = 0; k < n; ++k) to[k] = from[k];
  }
}

/// Adds a chunk to the sums of its particles, pair by pair.
template <bool some_apart>
BRECCIA_KERNEL void add_up(const PairBatch& b, std::size_t first, std::size_t n, const Evaluated& e) {
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = b.i[first + k], j = b.j[first + k];
    if (!some_apart || !b.apart[i]) {
      double *f = b.sum_force[i].data(), *t = b.sum_torque[i].data();
      f[0] += e.fx[k];
      f[1] += e.fy[k];
      f[2] += e.fz[k];
      t[0] += e.tix[k];
      t[1] += e.tiy[k];
      t[2] += e.tiz[k];
    }
    if (!some_apart || !b.apart[j]) {
      double *f = b.sum_force[j].data(), *t = b.sum_torque[j].data();
      f[0] -= e.fx[k];
      f[1] -= e.fy[k];
      f[2] -= e.fz[k];
      t[0] += e.tjx[k];
      t[1] += e.tjy[k];
      t[2] += e.tjz[k];
    }
  }
}

/// Sum in eight lanes, always the same ones: quick, and the same bits whatever the vector width.
BRECCIA_KERNEL double lane_sum(const double* v, std::size_t n) {
  double lane[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += v[k + l];
  for (; k < n; ++k) lane[k % 8] += v[k];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/// Pairs [first, first + n) of the batch.
template <class Law, bool guarded>
BRECCIA_KERNEL void evaluate_chunk(const Law& law, const PairBatch& b, std::size_t first, std::size_t n, Gathered& g,
                                   NewState<Law>& next, Evaluated& e) {
  gather<law_needs_mass<Law>(), guarded>(b, first, n, g);
  double* h[Law::columns.size() + 1];
  for (std::size_t c = 0; c < Law::columns.size(); ++c) h[c] = b.columns[c] + first;
  const double* rest = b.rest_length + first;
  const double dt = b.time_step;
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) evaluate_lane<Law, guarded>(law, g, h, next, rest[k], dt, k, e);
  write_back(next, h, n);
  const std::size_t at = first / PairBatch::chunk;
  const bool some_apart = b.chunk_apart && b.chunk_apart[at];
  if (b.keep_force || some_apart) {
    for (std::size_t k = 0; k < n; ++k)
      b.force[first + k] = {e.fx[k], e.fy[k], e.fz[k], e.tx[k], e.ty[k], e.tz[k], e.half_gap[k], 0.0};
    if constexpr (law_has_moments<Law>())
      for (std::size_t k = 0; k < n; ++k) b.moment[first + k] = Vec3(e.mx[k], e.my[k], e.mz[k]);
  }
  if (b.sum_force) some_apart ? add_up<true>(b, first, n, e) : add_up<false>(b, first, n, e);
  b.friction_work[at] += lane_sum(e.friction, n);
  b.contact_work[at] += lane_sum(e.contact, n);
  b.fracture_energy[at] += lane_sum(e.fracture, n);
  if (lane_sum(e.breaks, n) > 0) {
    b.chunk_broke[at] = 1;
    for (std::size_t k = 0; k < n; ++k)
      if (e.breaks[k] > 0) b.state[first + k] = static_cast<BondState>(static_cast<int>(e.breaks[k]));
  }
}

/// The step loop. `law` comes by value: its constants stay in registers. `guarded`: some bonds are protected; a loop of
/// its own, as telling them apart would cost all others 8 %.
template <class Law, bool guarded>
BRECCIA_VECTOR_CLONES void evaluate_pairs(const Law law, const PairBatch& b) {
  Gathered g;
  NewState<Law> next;
  Evaluated e;
  for (std::size_t first = b.begin; first < b.end; first += PairBatch::chunk)
    evaluate_chunk<Law, guarded>(law, b, first, std::min(PairBatch::chunk, b.end - first), g, next, e);
}

/// Calls `f(contact, k)` for each pair of the batch: for what is done rarely.
template <class Law, class F>
void for_each_contact(const PairBatch& b, F&& f) {
  Gathered g;
  for (std::size_t k = b.begin; k < b.end; ++k) {
    gather<true, false>(b, k, 1, g);
    f(contact_of<true, false>(g, 0, b.rest_length[k], b.time_step), k);
  }
}

}  // namespace detail

}  // namespace breccia
