// SPDX-License-Identifier: BSD-3-Clause
#include "engine/interactions.hpp"

#include <algorithm>
#include <utility>

#include "breccia/error.hpp"
#include "engine/chunk_transfer.hpp"
#include "engine/counter_random.hpp"

namespace breccia {
namespace {

/// Sum in eight lanes, always the same ones: quick, and the same bits whatever the vector width.
BRECCIA_KERNEL double lane_sum(const double* v, std::size_t n) {
  double lane[8] = {};
  std::size_t k = 0;
  for (; k + 8 <= n; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += v[k + l];
  for (; k < n; ++k) lane[k % 8] += v[k];
  return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
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
    std::vector<ContactLaw*> all{l.law};  // in the same order on all ranks: they may ask each other
    for (ContactLaw* of_kind : l.of_kind)
      if (std::find(all.begin(), all.end(), of_kind) == all.end()) all.push_back(of_kind);
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
