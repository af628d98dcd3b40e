// SPDX-License-Identifier: BSD-3-Clause
#include "engine/interactions.hpp"

#include <algorithm>
#include <utility>

#include "breccia/error.hpp"
#include "engine/counter_random.hpp"
#include "engine/four.hpp"

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

/// Asks for the second particles of pairs [first, end), which come from anywhere, while the chunk before them is worked
/// on. The first ones, and all that belongs to pairs, come in order: asked for as well, they are in the way.
void fetch_ahead(const PairBatch& b, std::size_t first, std::size_t end) {
  for (std::size_t k = first; k < end; ++k) {
    const ParticleMotion& of = b.motion[b.j[k]];
    __builtin_prefetch(&of.position);
    __builtin_prefetch(&of.angular_velocity);
    if (b.sum) __builtin_prefetch(&b.sum[b.j[k]], 1);
  }
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

/// By how many cells each j is taken back to be the image nearest to i.
struct alignas(64) PairImages {
  double x[PairChunk::capacity], y[PairChunk::capacity], z[PairChunk::capacity];
};

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

void gather_chunk(const PairBatch& b, std::size_t first, std::size_t n, bool with_mass, PairChunk& g, PairImages& m) {
  gather_particles(b, first, n, with_mass, g);
  if (b.cell) to_nearest_images(*b.cell, *b.cell_velocity, g, m);
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

/// Sum in eight lanes, always the same ones: quick, and the same bits whatever the vector width.
BRECCIA_KERNEL double lane_sum(const double* v, std::size_t n) {
  double lane[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += v[k + l];
  for (; k < n; ++k) lane[k % 8] += v[k];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/// Forces of chunk [first, first + n) to memory where they are wanted, and to the sums of their particles.
BRECCIA_VECTOR_CLONES void scatter_chunk(const PairBatch& b, std::size_t at, std::size_t first, bool moments,
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

/// Whether any of it was by bonds that broke.
BRECCIA_VECTOR_CLONES bool add_dissipated(const PairAnswer& e, std::size_t n, Dissipated& sum) {
  sum.friction += lane_sum(e.friction, n);
  sum.contact += lane_sum(e.contact, n);
  const double fracture = lane_sum(e.fracture, n);
  sum.fracture += fracture;
  return fracture != 0;
}

/// Few pairs in few steps.
void record_released(const PairBatch& b, std::size_t first, std::size_t n, const PairAnswer& e) {
  for (std::size_t k = 0; k < n; ++k)
    if (e.fracture[k] != 0) b.released->push_back({Index(first + k), e.fracture[k]});
}

BRECCIA_VECTOR_CLONES bool any_breaks(const PairAnswer& e, std::size_t n) { return lane_sum(e.breaks, n) > 0; }

/// sum over the chunk of a (x) b.
Mat3 dyad_sum(const double* const (&a)[3], const double* const (&b)[3], std::size_t n) {
  Mat3 sum;
  double product[PairChunk::capacity];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < n; ++k) product[k] = a[r][k] * b[c][k];
      sum(r, c) = lane_sum(product, n);
    }
  return sum;
}

CellForces forces_on_cell(const PairChunk& g, const PairImages& m, const PairAnswer& e) {
  const double *const force[3] = {e.fx, e.fy, e.fz}, *const branch[3] = {g.dx, g.dy, g.dz},
                      *const image[3] = {m.x, m.y, m.z};
  return {dyad_sum(force, image, g.size), dyad_sum(branch, force, g.size)};
}

void record_breaks(const PairBatch& b, std::size_t at, std::size_t first, std::size_t n, const PairAnswer& e) {
  if (!any_breaks(e, n)) return;
  b.chunk_broke[at] = 1;
  for (std::size_t k = 0; k < n; ++k)
    if (e.breaks[k] > 0) b.state[first + k] = static_cast<BondState>(static_cast<int>(e.breaks[k]));
}

/// Calls `f(first, chunk, rows)` for the chunks of the batch, with their masses; `rows` are all columns from `first`
/// on.
template <class F>
void for_each_chunk(const PairBatch& b, std::size_t columns, F&& f) {
  PairChunk chunk;
  PairImages images;
  std::vector<double*> rows(columns);
  for (std::size_t first = b.begin; first < b.end; first += PairBatch::chunk) {
    gather_chunk(b, first, std::min(PairBatch::chunk, b.end - first), true, chunk, images);
    for (std::size_t c = 0; c < columns; ++c) rows[c] = b.columns[c] + first;
    f(first, chunk, rows.data());
  }
}

}  // namespace

Interactions::Interactions(std::vector<NamedLaw> laws) : laws_(std::move(laws)) {
  std::string maker;
  for (const NamedLaw& l : laws_) {
    first_column_.push_back(columns_);
    columns_ += l.law->columns().size() + l.scatter.size();
    has_kinds_ |= !l.of_kind.empty();
    has_moments_ |= l.law->has_moments();
    needs_mass_ |= l.law->needs_mass();
    if (!l.law->makes_bonds()) continue;
    if (makes_bonds_)
      throw UserError("contact_law: `" + maker + "` and `" + l.name +
                      "` both make bonds: of a list of laws one may, the others add to it");
    maker = l.name;
    makes_bonds_ = true;
    respects_protection_ = l.law->respects_protection();
  }
}

std::string Interactions::names() const {
  std::string text;
  for (std::size_t k = 0; k < laws_.size(); ++k)
    text += (k == 0 ? "" : k + 1 == laws_.size() ? " and " : ", ") + ("`" + laws_[k].name + "`");
  return text;
}

void Interactions::prepare(const Assembly& assembly) {
  for (const NamedLaw& l : laws_) {
    std::vector<std::string> scattered;
    for (const ScatteredParameter& p : l.scatter) scattered.push_back(p.name);
    std::vector<ContactLaw*> all = l.of_kind;
    all.push_back(l.law);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (ContactLaw* law : all) {
      law->scatter(scattered);
      law->prepare(assembly);
    }
    if (!l.of_kind.empty()) l.law->take_kinds(l.of_kind);
  }
}

double drawn(const NamedLaw& law, const ScatteredParameter& parameter, const Distribution& distribution, Index a,
             Index b) {
  const std::uint64_t stream = stream_of(law.name + "." + parameter.name);
  return distribution.quantile(uniform(law.seed, stream, std::min(a, b), std::max(a, b))) / distribution.mean;
}

void Interactions::draw(const PairBatch& b) const {
  for (std::size_t l = 0; l < laws_.size(); ++l) {
    const NamedLaw& law = laws_[l];
    const std::size_t next = l + 1 < laws_.size() ? first_column_[l + 1] : columns_;
    for (std::size_t s = 0; s < law.scatter.size(); ++s) {
      const ScatteredParameter& parameter = law.scatter[s];
      double* column = b.columns[next - law.scatter.size() + s];
      for (std::size_t k = b.begin; k < b.end; ++k) {
        const Index i = b.i[k], j = b.j[k];
        const std::size_t kind =
            b.material && parameter.of_kind.size() > 1 ? kind_of_pair(b.material[i], b.material[j], b.materials) : 0;
        const auto& distribution = parameter.of_kind[kind];
        column[k] = distribution && b.state[k] != BondState::unbonded
                        ? drawn(law, parameter, *distribution, b.id[i], b.id[j])
                        : 1.0;
      }
    }
  }
}

void Interactions::initialise(const PairBatch& b) const {
  draw(b);
  for_each_chunk(b, columns_, [&](std::size_t, const PairChunk& chunk, double* const* rows) {
    for (std::size_t l = 0; l < laws_.size(); ++l) laws_[l].law->initialise(chunk, rows + first_column_[l]);
  });
}

void Interactions::evaluate(const PairBatch& b) const {
  PairChunk chunk;
  PairImages images;
  PairAnswer answer;
  std::vector<double*> rows(columns_);
  const bool clear_moments = has_moments_ && !laws_.front().law->has_moments();  // the first law does not write them
  std::size_t at = b.chunk_start ? b.first_chunk : b.begin / PairBatch::chunk, n = 0;
  for (std::size_t first = b.begin; first < b.end; first += n, ++at) {
    n = b.chunk_start ? b.chunk_start[at + 1] - first : std::min(PairBatch::chunk, b.end - first);
    fetch_ahead(b, first + n, std::min(first + 2 * n, b.end));
    gather_chunk(b, first, n, needs_mass_, chunk, images);
    for (std::size_t c = 0; c < columns_; ++c) rows[c] = b.columns[c] + first;
    Dissipated* dissipated = b.dissipated + laws_.size() * at;
    if (clear_moments)
      for (double* m : {answer.mx, answer.my, answer.mz}) std::fill(m, m + n, 0.0);
    for (std::size_t l = 0; l < laws_.size(); ++l) {
      laws_[l].law->evaluate(chunk, rows.data() + first_column_[l], answer, l > 0);
      if (add_dissipated(answer, n, dissipated[l]) && b.released) record_released(b, first, n, answer);
    }
    scatter_chunk(b, at, first, has_moments_, chunk, answer);
    if (b.cell_forces) b.cell_forces[at] = forces_on_cell(chunk, images, answer);
    if (makes_bonds_) record_breaks(b, at, first, n, answer);
  }
}

void Interactions::stiffness(const PairBatch& b, ContactStiffness* out) const {
  for_each_chunk(b, columns_, [&](std::size_t first, const PairChunk& chunk, double* const* rows) {
    ContactStiffness* to = out + (first - b.begin);
    laws_.front().law->stiffness(chunk, rows, to);
    for (std::size_t l = 1; l < laws_.size(); ++l) {
      ContactStiffness one[PairChunk::capacity];
      laws_[l].law->stiffness(chunk, rows + first_column_[l], one);
      for (std::size_t k = 0; k < chunk.size; ++k) to[k] = to[k] + one[k];
    }
  });
}

double Interactions::energy(const PairBatch& b) const {
  double sum = 0;
  for (std::size_t l = 0; l < laws_.size(); ++l) sum += energy(b, l);
  return sum;
}

double Interactions::energy(const PairBatch& b, std::size_t l) const {
  double sum = 0;
  for_each_chunk(b, columns_, [&](std::size_t, const PairChunk& chunk, double* const* rows) {
    double of_pair[PairChunk::capacity];
    laws_[l].law->energy(chunk, rows + first_column_[l], of_pair);
    for (std::size_t k = 0; k < chunk.size; ++k) sum += of_pair[k];
  });
  return sum;
}

PairBatch whole_batch(State& s, std::vector<double*>& column_pointers) {
  column_pointers.clear();
  for (auto& c : s.pairs.columns) column_pointers.push_back(c.data());
  PairBatch b;
  b.end = s.pairs.size();
  b.i = s.pairs.i.data();
  b.j = s.pairs.j.data();
  b.rest_length = s.pairs.rest_length.data();
  b.state = s.pairs.state.data();
  b.columns = column_pointers.data();
  b.motion = s.particles.motion.data();
  b.id = s.particles.id.data();
  if (!s.particles.material.empty()) b.material = s.particles.material.data();
  b.materials = s.materials.size();
  b.force = s.pairs.force.data();
  b.moment = s.pairs.moment.data();
  b.time_step = s.time_step;
  if (s.cell.repeats()) {
    b.cell = &s.cell;
    b.cell_velocity = &s.cell_velocity;
  }
  return b;
}

}  // namespace breccia
