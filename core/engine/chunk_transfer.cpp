// SPDX-License-Identifier: BSD-3-Clause
#include "engine/chunk_transfer.hpp"

#include <algorithm>

#include "engine/four.hpp"
#include "engine/interactions.hpp"

namespace breccia {
namespace {

/// Writes the columns of four rows; the last only where somebody wants it.
BRECCIA_KERNEL void turn_into(Four (&row)[4], double* x, double* y, double* z, double* last) {
  transpose(row[0], row[1], row[2], row[3]);
  four(x) = row[0];
  four(y) = row[1];
  four(z) = row[2];
  if (last) four(last) = row[3];
}

template <bool with_mass, bool guarded>
BRECCIA_KERNEL void gather(const PairBatch& b, std::size_t first, std::size_t n, PairChunk& g) {
  g.size = n;
  g.time_step = b.time_step;
  g.breakable = guarded ? g.may_break : g.intact;
  const ParticleMotion* const of = b.motion;
  const Index *const first_i = b.i + first, *const first_j = b.j + first;
  for (std::size_t k = 0; k < n; k += 4) {
    Index i[4], j[4];
    for (std::size_t l = 0; l < 4; ++l) {  // past the end the last pair once more: nobody reads that
      const std::size_t pair = std::min(k + l, n - 1);
      i[l] = first_i[pair];
      j[l] = first_j[pair];
    }
    Four row[4];
    for (int l = 0; l < 4; ++l) row[l] = four(of[j[l]].position) - four(of[i[l]].position);
    turn_into(row, g.dx + k, g.dy + k, g.dz + k, nullptr);
    for (int l = 0; l < 4; ++l) row[l] = four(of[j[l]].velocity) - four(of[i[l]].velocity);
    turn_into(row, g.vx + k, g.vy + k, g.vz + k, nullptr);
    for (int l = 0; l < 4; ++l) row[l] = four(of[i[l]].angular_velocity);
    turn_into(row, g.wix + k, g.wiy + k, g.wiz + k, g.ri + k);
    for (int l = 0; l < 4; ++l) row[l] = four(of[j[l]].angular_velocity);
    turn_into(row, g.wjx + k, g.wjy + k, g.wjz + k, g.rj + k);
  }
  if constexpr (with_mass)
    for (std::size_t k = 0; k < n; ++k) {
      g.mi[k] = of[b.i[first + k]].mass;
      g.mj[k] = of[b.j[first + k]].mass;
    }
  for (std::size_t k = 0; k < n; ++k) {
    g.rest[k] = b.rest_length[first + k];
    g.intact[k] = double(b.state[first + k] == BondState::intact);
  }
  g.mixed = false;
  if (b.material) {
    for (std::size_t k = 0; k < n; ++k) {
      g.kind[k] = kind_of_pair(b.material[b.i[first + k]], b.material[b.j[first + k]], b.materials);
      g.mixed |= g.kind[k] != g.kind[0];
    }
  }
  if constexpr (guarded)
    for (std::size_t k = 0; k < n; ++k) g.may_break[k] = b.guarded[first + k] ? 0.0 : g.intact[k];
}

BRECCIA_VECTOR_CLONES void gather_particles(const PairBatch& b, std::size_t first, std::size_t n, bool with_mass,
                                            PairChunk& g) {
  if (b.guarded) with_mass ? gather<true, true>(b, first, n, g) : gather<false, true>(b, first, n, g);
  else with_mass ? gather<true, false>(b, first, n, g) : gather<false, false>(b, first, n, g);
}

/// The image moves with the cell, too.
BRECCIA_VECTOR_CLONES void to_nearest_images(const Cell& cell, const Mat3& velocity, PairChunk& g, PairImages& m) {
  const Mat3 w = cell.inverse(), v = cell.vectors(), u = velocity;
  const std::size_t n = g.size;
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) {
    const double x = g.dx[k], y = g.dy[k], z = g.dz[k];
    const double a = nearest_whole(w(0, 0) * x + w(0, 1) * y + w(0, 2) * z),
                 b = nearest_whole(w(1, 0) * x + w(1, 1) * y + w(1, 2) * z),
                 c = nearest_whole(w(2, 0) * x + w(2, 1) * y + w(2, 2) * z);
    m.x[k] = a;
    m.y[k] = b;
    m.z[k] = c;
    g.dx[k] = x - (v(0, 0) * a + v(0, 1) * b + v(0, 2) * c);
    g.dy[k] = y - (v(1, 0) * a + v(1, 1) * b + v(1, 2) * c);
    g.dz[k] = z - (v(2, 0) * a + v(2, 1) * b + v(2, 2) * c);
    g.vx[k] -= u(0, 0) * a + u(0, 1) * b + u(0, 2) * c;
    g.vy[k] -= u(1, 0) * a + u(1, 1) * b + u(1, 2) * c;
    g.vz[k] -= u(2, 0) * a + u(2, 1) * b + u(2, 2) * c;
  }
}

/// Adds a chunk to the sums of its particles, pair by pair. Torques: lever arm times n x shear force, and the moment,
/// as `complete_forces` has them for particles that are summed apart: from sums over the laws.
template <bool moments, bool some_apart>
BRECCIA_KERNEL void add_up(const PairBatch& b, std::size_t first, const PairChunk& g, const PairAnswer& e) {
  const Four none = {0, 0, 0, 0};
  const std::size_t size = g.size;
  ParticleLoad* const sum = b.sum;
  const Index *const first_i = b.i + first, *const first_j = b.j + first;
  const std::uint8_t* const apart = b.apart;
  for (std::size_t k = 0; k < size; k += 4) {
    const Four half_gap = four(e.half_gap + k), arm_i = four(g.ri + k) + half_gap, arm_j = four(g.rj + k) + half_gap;
    const Four tx = four(e.tx + k), ty = four(e.ty + k), tz = four(e.tz + k);
    Four force[4] = {four(e.fx + k), four(e.fy + k), four(e.fz + k), none},
         on_i[4] = {arm_i * tx, arm_i * ty, arm_i * tz, none}, on_j[4] = {arm_j * tx, arm_j * ty, arm_j * tz, none};
    if constexpr (moments) {
      const Four moment[3] = {four(e.mx + k), four(e.my + k), four(e.mz + k)};
      for (int c = 0; c < 3; ++c) {
        on_i[c] += moment[c];
        on_j[c] -= moment[c];
      }
    }
    transpose(force[0], force[1], force[2], force[3]);
    transpose(on_i[0], on_i[1], on_i[2], on_i[3]);
    transpose(on_j[0], on_j[1], on_j[2], on_j[3]);
    const auto add = [&](std::size_t l) __attribute__((always_inline)) {
      const Index i = first_i[k + l], j = first_j[k + l];
      if (!some_apart || !apart[i]) {
        four(sum[i].force) += force[l];
        four(sum[i].torque) += on_i[l];
      }
      if (!some_apart || !apart[j]) {
        four(sum[j].force) -= force[l];
        four(sum[j].torque) += on_j[l];
      }
    };
    if (const std::size_t some = size - k; some >= 4) {
      add(0);
      add(1);
      add(2);
      add(3);
    } else {
      for (std::size_t l = 0; l < some; ++l) add(l);
    }
  }
}

BRECCIA_VECTOR_CLONES void scatter(const PairBatch& b, std::size_t at, std::size_t first, bool moments,
                                   const PairChunk& g, const PairAnswer& e) {
  const std::size_t n = g.size;
  const bool some_apart = b.chunk_cut && b.chunk_cut[at] != PairBatch::whole;
  if (some_apart) {
    CutForce* const cut = b.cut + b.chunk_cut[at];
    for (std::size_t k = 0; k < n; ++k)
      cut[k] = {e.fx[k], e.fy[k], e.fz[k], e.tx[k], e.ty[k], e.tz[k], e.half_gap[k], 0, 0, 0};
    for (std::size_t k = 0; moments && k < n; ++k) {
      cut[k].mx = e.mx[k];
      cut[k].my = e.my[k];
      cut[k].mz = e.mz[k];
    }
  }
  if (b.keep_force) {
    for (std::size_t k = 0; k < n; ++k) b.force[first + k] = {e.fx[k], e.fy[k], e.fz[k], e.half_gap[k]};
    if (moments)
      for (std::size_t k = 0; k < n; ++k) b.moment[first + k] = Vec3(e.mx[k], e.my[k], e.mz[k]);
  }
  if (!b.sum) return;
  if (moments) some_apart ? add_up<true, true>(b, first, g, e) : add_up<true, false>(b, first, g, e);
  else some_apart ? add_up<false, true>(b, first, g, e) : add_up<false, false>(b, first, g, e);
}

}  // namespace

void fetch_ahead(const PairBatch& b, std::size_t first, std::size_t end) {
  for (std::size_t k = first; k < end; ++k) {
    const ParticleMotion& of = b.motion[b.j[k]];
    __builtin_prefetch(&of.position);
    __builtin_prefetch(&of.angular_velocity);
    if (b.sum) __builtin_prefetch(&b.sum[b.j[k]], 1);
  }
}

void gather_chunk(const PairBatch& b, std::size_t first, std::size_t n, bool with_mass, PairChunk& g, PairImages& m) {
  gather_particles(b, first, n, with_mass, g);
  if (b.cell) to_nearest_images(*b.cell, *b.cell_velocity, g, m);
}

void scatter_chunk(const PairBatch& b, std::size_t at, std::size_t first, bool moments, const PairChunk& g,
                   const PairAnswer& e) {
  scatter(b, at, first, moments, g, e);
}

}  // namespace breccia
