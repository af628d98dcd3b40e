// SPDX-License-Identifier: BSD-3-Clause
#include "engine/neighbours.hpp"

#include <algorithm>

#include "breccia/cell_grid.hpp"

namespace breccia {
namespace {

double distance(const Particles& p, Index i, Index j) { return (p.position[j] - p.position[i]).norm(); }

/// Rows of `pairs` that start with each i: [start[i], start[i + 1]).
std::vector<std::size_t> rows_by_first(const std::vector<Index>& first, std::size_t particles) {
  std::vector<std::size_t> start(particles + 1, 0);
  for (const Index i : first) ++start[i + 1];
  for (std::size_t k = 0; k < particles; ++k) start[k + 1] += start[k];
  return start;
}

void resize(Pairs& p, std::size_t n, std::size_t columns, bool moments) {
  p.i.resize(n); p.j.resize(n); p.bond.resize(n); p.rest_length.resize(n); p.state.resize(n);
  p.columns.resize(columns);
  for (auto& c : p.columns) c.resize(n);
  p.force.assign(n, PairForce{});
  if (moments) p.moment.assign(n, Vec3::Zero());
}

}  // namespace

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
  b.position = s.particles.position.data();
  b.velocity = s.particles.velocity.data();
  b.angular_velocity = s.particles.angular_velocity.data();
  b.radius = s.particles.radius.data();
  b.mass = s.particles.mass.data();
  b.force = s.pairs.force.data();
  b.moment = s.pairs.moment.data();
  b.time_step = s.time_step;
  return b;
}

std::vector<Index> rebuild_pairs(State& s, ContactLaw& law, double skin) {
  const Particles& p = s.particles;
  const std::size_t n = p.size();
  const Pairs old = std::move(s.pairs);
  const auto old_start = rows_by_first(old.i, n);
  const auto bond_start = rows_by_first(s.bonds.i, n);
  const bool first_time = old.size() == 0;
  constexpr std::size_t fresh = SIZE_MAX;

  std::vector<Index> new_i, new_j;
  std::vector<std::size_t> from;  // row in `old`, or fresh
  std::vector<Index> partners;
  const double largest = *std::max_element(p.radius.begin(), p.radius.end());
  const CellGrid grid(p.position, 2 * largest + skin);
  for (Index i = 0; i < n; ++i) {
    partners.clear();
    grid.for_each_near(p.position[i], [&](Index j) {
      if (j > i && distance(p, i, j) < p.radius[i] + p.radius[j] + skin) partners.push_back(j);
    });
    for (std::size_t k = old_start[i]; k < old_start[i + 1]; ++k)
      if (old.state[k] == BondState::intact || distance(p, i, old.j[k]) < old.rest_length[k] + skin) partners.push_back(old.j[k]);
    if (first_time)
      for (std::size_t k = bond_start[i]; k < bond_start[i + 1]; ++k) partners.push_back(s.bonds.j[k]);
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    for (const Index j : partners) {
      const auto begin = old.j.begin() + std::ptrdiff_t(old_start[i]), end = old.j.begin() + std::ptrdiff_t(old_start[i + 1]);
      const auto at = std::lower_bound(begin, end, j);
      new_i.push_back(i);
      new_j.push_back(j);
      from.push_back(at != end && *at == j ? std::size_t(at - old.j.begin()) : fresh);
    }
  }

  Pairs& q = s.pairs;
  q = {};
  resize(q, new_i.size(), law.columns().size(), law.has_moments());
  q.i = std::move(new_i);
  q.j = std::move(new_j);
  std::fill(s.bonds.pair.begin(), s.bonds.pair.end(), BondsView::no_pair);
  for (std::size_t k = 0; k < q.size(); ++k) {
    const Index i = q.i[k], j = q.j[k];
    if (from[k] != fresh) {
      q.bond[k] = old.bond[from[k]];
      q.rest_length[k] = old.rest_length[from[k]];
      q.state[k] = old.state[from[k]];
      for (std::size_t c = 0; c < q.columns.size(); ++c) q.columns[c][k] = old.columns[c][from[k]];
    } else {
      const auto begin = s.bonds.j.begin() + std::ptrdiff_t(bond_start[i]), end = s.bonds.j.begin() + std::ptrdiff_t(bond_start[i + 1]);
      const auto at = std::lower_bound(begin, end, j);
      const bool bonded = first_time && at != end && *at == j;
      q.bond[k] = bonded ? Index(at - s.bonds.j.begin()) : PairsView::no_bond;
      q.state[k] = bonded ? BondState::intact : BondState::unbonded;
      q.rest_length[k] = bonded ? s.bonds.initial_distance[q.bond[k]] : std::min(distance(p, i, j), p.radius[i] + p.radius[j]);
    }
    if (q.bond[k] != PairsView::no_bond) s.bonds.pair[q.bond[k]] = Index(k);
  }
  std::vector<double*> columns;
  PairBatch batch = whole_batch(s, columns);
  std::vector<Index> changed;
  for (std::size_t k = 0; k < q.size(); ++k)
    if (from[k] == fresh) {
      batch.begin = k;
      batch.end = k + 1;
      law.initialise(batch);
      changed.insert(changed.end(), {q.i[k], q.j[k]});
    }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  s.positions_at_rebuild = p.position;
  s.moved_bound = s.walls_moved = 0;
  return changed;
}

Incidence make_incidence(const State& s) {
  Incidence in;
  in.start.assign(s.particles.size() + 1, 0);
  const Pairs& q = s.pairs;
  BRECCIA_ASSERT(q.size() < (std::size_t(1) << 31));
  for (std::size_t k = 0; k < q.size(); ++k) { ++in.start[q.i[k] + 1]; ++in.start[q.j[k] + 1]; }
  for (std::size_t k = 0; k < s.particles.size(); ++k) in.start[k + 1] += in.start[k];
  in.entry.resize(2 * q.size());
  std::vector<std::size_t> next(in.start.begin(), in.start.end() - 1);
  for (std::size_t k = 0; k < q.size(); ++k) {
    in.entry[next[q.i[k]]++] = Index(2 * k);
    in.entry[next[q.j[k]]++] = Index(2 * k + 1);
  }
  return in;
}

double largest_displacement_since_rebuild(const State& s) {
  double most = 0;
  for (std::size_t k = 0; k < s.particles.size(); ++k)
    most = std::max(most, (s.particles.position[k] - s.positions_at_rebuild[k]).squaredNorm());
  return std::sqrt(most);
}

}  // namespace breccia
