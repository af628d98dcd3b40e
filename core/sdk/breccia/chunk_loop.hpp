// SPDX-License-Identifier: BSD-3-Clause
/// A law over one chunk of pairs, instantiated inside its plugin: geometry and law fused in one vector loop.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "breccia/chunk.hpp"
#include "breccia/contact.hpp"

namespace breccia::detail {

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
  double column[Law::columns.size() + 1][PairChunk::capacity];
};
template <class Law, std::size_t... K>
BRECCIA_KERNEL void store_state(typename Law::State& s, NewState<Law>& h, std::size_t k, std::index_sequence<K...>) {
  ((h.column[K][k] = column_of<Law, K>(s)), ...);
}

/// Coincident centres have no normal: the floor on the distance keeps the result finite (and the force zero).
template <bool with_mass>
BRECCIA_KERNEL Contact contact_of(const PairChunk& g, std::size_t k, double dt, double normal_force) {
  const double d = std::sqrt(g.dx[k] * g.dx[k] + g.dy[k] * g.dy[k] + g.dz[k] * g.dz[k]);
  const double inverse = 1.0 / (d > 1e-300 ? d : 1e-300);
  Contact c;
  c.distance = d;
  c.rest_length = g.rest[k];
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
  c.breakable = g.breakable[k];
  c.normal_force = normal_force;
  if constexpr (with_mass) c.reduced_mass = g.mi[k] * g.mj[k] / (g.mi[k] + g.mj[k]);
  else c.reduced_mass = 0;
  c.time_step = dt;
  return c;
}

/// Constants of a law that each bond has of its own, as many as the law names in `per_bond()`.
template <class Law>
constexpr std::size_t per_bond_count() {
  if constexpr (requires { Law::per_bond(); }) return Law::per_bond().size();
  else return 0;
}

/// A law as words of memory, which it may be copied as: so its constants can be laid out as arrays over the pairs of a
/// chunk without their names. Words are only moved, whatever they hold.
template <class Law>
using LawWords = std::array<double, (sizeof(Law) + sizeof(double) - 1) / sizeof(double)>;
template <class Law>
constexpr std::size_t word_count = std::tuple_size_v<LawWords<Law>>;

/// The laws of all kinds of pairs.
template <class Law>
struct LawTable {
  std::vector<LawWords<Law>> of_kind;
  std::vector<std::size_t> differing;  ///< words that are not the same in all of them

  LawTable() = default;
  explicit LawTable(const std::vector<Law>& laws) : of_kind(laws.size()) {
    for (std::size_t k = 0; k < laws.size(); ++k) std::memcpy(&of_kind[k], &laws[k], sizeof(Law));
    for (std::size_t w = 0; w < word_count<Law>; ++w)
      if (std::any_of(of_kind.begin(), of_kind.end(), [&](const auto& words) {
            return std::bit_cast<std::uint64_t>(words[w]) != std::bit_cast<std::uint64_t>(of_kind[0][w]);
          }))
        differing.push_back(w);
  }
};

/// What differs from pair to pair besides its contact: the law by kind of pair, and what each bond was given.
template <class Law>
struct Variety {
  const Law* of_kind = nullptr;
  const LawTable<Law>* table = nullptr;                           ///< the same
  const std::uint32_t* kind = nullptr;                            ///< of the chunk's pairs; null: all are of the first
  std::array<const double*, per_bond_count<Law>() + 1> factor{};  ///< of the chunk's bonds, one array a constant
};

template <class Law, std::size_t K>
BRECCIA_KERNEL void scale_constant(Law& law, double factor) {
  constexpr auto member = Law::per_bond()[K].member;
  if constexpr (Law::per_bond()[K].inverse) law.*member /= factor;
  else law.*member *= factor;
}
template <class Law, std::size_t... K>
BRECCIA_KERNEL void scale_constants(Law& law, const Variety<Law>& v, [[maybe_unused]] std::size_t k,
                                    std::index_sequence<K...>) {
  (scale_constant<Law, K>(law, v.factor[K][k]), ...);
}
template <class Law>
BRECCIA_KERNEL Law law_of(const Variety<Law>& v, std::size_t k) {
  Law law = v.of_kind[v.kind ? v.kind[k] : 0];
  scale_constants(law, v, k, std::make_index_sequence<per_bond_count<Law>()>{});
  return law;
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

template <class Law>
constexpr bool law_makes_bonds() {
  if constexpr (requires { Law::makes_bonds; }) return Law::makes_bonds;
  else return true;
}

/// One lane of the vector loop. A function of its own: aggregates declared in an `omp simd` body stay in memory, those
/// of an inlined function become registers (a factor of three). `adds`: to what the laws before have answered.
template <class Law, bool adds>
BRECCIA_KERNEL void evaluate_lane(const Law& law, const PairChunk& g, double* const* h, NewState<Law>& next, double dt,
                                  std::size_t k, PairAnswer& out) {
  constexpr auto all = std::make_index_sequence<Law::columns.size()>{};
  const Contact c = contact_of<law_needs_mass<Law>()>(g, k, dt, adds ? out.normal[k] : 0.0);
  typename Law::State s;
  load_state<Law>(s, h, k, all);
  const ContactForce f = law(c, s);
  store_state<Law>(s, next, k, all);
  const auto put = [k](double* to, double value) { to[k] = adds ? to[k] + value : value; };
  put(out.fx, f.normal * c.nx + f.shear_x);
  put(out.fy, f.normal * c.ny + f.shear_y);
  put(out.fz, f.normal * c.nz + f.shear_z);
  put(out.normal, f.normal);
  const double tx = c.ny * f.shear_z - c.nz * f.shear_y, ty = c.nz * f.shear_x - c.nx * f.shear_z,
               tz = c.nx * f.shear_y - c.ny * f.shear_x;
  put(out.tx, tx);
  put(out.ty, ty);
  put(out.tz, tz);
  if constexpr (law_has_moments<Law>()) {
    put(out.mx, f.moment_x);
    put(out.my, f.moment_y);
    put(out.mz, f.moment_z);
  }
  if constexpr (!adds) out.half_gap[k] = 0.5 * (c.distance - c.radius_i - c.radius_j);
  if constexpr (law_makes_bonds<Law>()) out.breaks[k] = f.breaks;
  else if constexpr (!adds) out.breaks[k] = 0;
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

/// `law` comes by value: its constants stay in registers.
template <class Law, bool adds>
BRECCIA_VECTOR_CLONES void evaluate_chunk(const Law law, const PairChunk& g, double* const* h, PairAnswer& out) {
  NewState<Law> next;
  const std::size_t n = g.size;
  const double dt = g.time_step;
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) evaluate_lane<Law, adds>(law, g, h, next, dt, k, out);
  write_back(next, h, n);
}

/// The laws of a chunk's pairs, each word of theirs an array over the pairs: the vector loop reads it as it reads the
/// pairs. To look laws up by kind within that loop keeps them in memory, and the loop scalar.
template <class Law>
struct alignas(64) LawsOfPairs {
  double word[word_count<Law>][PairChunk::capacity];
};
template <class Law>
BRECCIA_KERNEL void spread_laws(const Variety<Law>& v, std::size_t n, LawsOfPairs<Law>& to) {
  const LawWords<Law>* const of_kind = v.table->of_kind.data();
  for (std::size_t w = 0; w < word_count<Law>; ++w) std::fill_n(to.word[w], PairChunk::capacity, of_kind[0][w]);
  for (std::size_t k = 0; k < n; ++k) {
    const LawWords<Law>& words = of_kind[v.kind[k]];
    for (const std::size_t w : v.table->differing) to.word[w][k] = words[w];
  }
}
template <class Law, std::size_t W>
BRECCIA_KERNEL void set_word(Law& law, double word) {
  constexpr std::size_t at = W * sizeof(double);
  std::memcpy(reinterpret_cast<char*>(&law) + at, &word, std::min(sizeof(double), sizeof(Law) - at));
}
template <class Law, std::size_t... W>
BRECCIA_KERNEL void take_law(Law& law, const LawsOfPairs<Law>& laws, std::size_t k, std::index_sequence<W...>) {
  (set_word<Law, W>(law, laws.word[W][k]), ...);
}

/// As `evaluate_lane`, with the pair's own law. A copy, and not in the loop, for the reason given there.
template <class Law, bool adds, bool by_kind>
BRECCIA_KERNEL void evaluate_varied_lane(const Law& first, const LawsOfPairs<Law>& laws, const Variety<Law>& v,
                                         const PairChunk& g, double* const* h, NewState<Law>& next, double dt,
                                         std::size_t k, PairAnswer& out) {
  Law law = first;
  if constexpr (by_kind) take_law(law, laws, k, std::make_index_sequence<word_count<Law>>{});
  scale_constants(law, v, k, std::make_index_sequence<per_bond_count<Law>()>{});
  evaluate_lane<Law, adds>(law, g, h, next, dt, k, out);
}

/// The same where constants of the law differ within the chunk: the laws of its pairs as a structure of arrays.
template <class Law, bool adds, bool by_kind>
BRECCIA_VECTOR_CLONES void evaluate_varied(const Variety<Law> v, const PairChunk& g, double* const* h,
                                           PairAnswer& out) {
  NewState<Law> next;
  LawsOfPairs<Law> laws;
  const std::size_t n = g.size;
  const double dt = g.time_step;
  const Law first = *v.of_kind;
  if constexpr (by_kind) spread_laws(v, n, laws);
#pragma omp simd
  for (std::size_t k = 0; k < n; ++k) evaluate_varied_lane<Law, adds, by_kind>(first, laws, v, g, h, next, dt, k, out);
  write_back(next, h, n);
}

/// Calls `f(contact, k)` for each pair of the chunk, which has its masses: for what is done rarely.
template <class F>
void for_each_contact(const PairChunk& chunk, F&& f) {
  for (std::size_t k = 0; k < chunk.size; ++k) f(contact_of<true>(chunk, k, chunk.time_step, 0.0), k);
}

}  // namespace breccia::detail
