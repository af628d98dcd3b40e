// SPDX-License-Identifier: BSD-3-Clause
#include "engine/neighbours.hpp"

#include <algorithm>
#include <utility>

#include "engine/chunks.hpp"
#include "engine/exact_sum.hpp"
#include "engine/neighbour_search.hpp"

namespace breccia {
namespace {

double distance(const State& s, Index i, Index j) {
  return s.branch(s.particles.position()[i], s.particles.position()[j]).norm();
}

/// Rows of `pairs` that start with each i: [start[i], start[i + 1]).
std::vector<std::size_t> rows_by_first(const std::vector<Index>& first, std::size_t particles) {
  std::vector<std::size_t> start(particles + 1, 0);
  for (const Index i : first) ++start[i + 1];
  for (std::size_t k = 0; k < particles; ++k) start[k + 1] += start[k];
  return start;
}

/// Whether a pair that is no bond knows more than two strangers would: a history that is not the one the law starts
/// with, or particles that overlapped when they were packed.
class Memory {
 public:
  Memory(State& s, const Pairs& old, const Interactions& law)
      : s_(s), old_(old), law_(law), fresh_(old.columns.size()), batch_(whole_batch(s, unused_)) {
    for (double& value : fresh_) columns_.push_back(&value);
    batch_.columns = columns_.data();
    batch_.guarded = nullptr;
    batch_.begin = 0;
    batch_.end = 1;
  }
  bool holds(std::size_t row) {
    const Index i = old_.i[row], j = old_.j[row];
    const auto r = s_.particles.radius();
    if (old_.bond[row] == PairsView::no_bond && old_.rest_length[row] < r[i] + r[j]) return true;
    BondState state = old_.state[row];
    batch_.i = &i;
    batch_.j = &j;
    batch_.rest_length = &old_.rest_length[row];
    batch_.state = &state;
    law_.initialise(batch_);
    for (std::size_t c = 0; c < fresh_.size(); ++c)
      if (old_.columns[c][row] != fresh_[c]) return true;
    return false;
  }

 private:
  State& s_;
  const Pairs& old_;
  const Interactions& law_;
  std::vector<double> fresh_;
  std::vector<double*> columns_, unused_;
  PairBatch batch_;
};

/// The rows of some particles, found by one thread.
struct Rows {
  static constexpr std::size_t particles = 512;
  static constexpr Index fresh = 0xffffffffu;
  std::vector<Index> i, j, from;  ///< row of the old list, or fresh
  std::size_t start = 0;          ///< in the new list
};

/// What is kept of one array of the old list, array by array: twice the whole list would be half of all memory.
class Sorter {
 public:
  Sorter(const std::vector<Rows>& blocks, std::size_t size, int threads)
      : blocks_(blocks), size_(size), threads_(threads) {}
  /// `spare` lends its memory and receives the old array.
  template <class T>
  void operator()(std::vector<T>& values, std::vector<T>& spare) const {
    spare.resize(size_);
#pragma omp parallel for schedule(dynamic) num_threads(threads_)
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Rows& rows = blocks_[b];
      for (std::size_t k = 0; k < rows.from.size(); ++k)
        if (rows.from[k] != Rows::fresh) spare[rows.start + k] = values[rows.from[k]];
    }
    std::swap(values, spare);
  }

 private:
  const std::vector<Rows>& blocks_;
  std::size_t size_;
  int threads_;
};

/// The same of the whole list; what new pairs begin with is left open.
void take_over(Pairs& q, std::vector<Rows>& blocks, std::size_t size, const Interactions& law, int threads) {
  q.i.resize(size);
  q.j.resize(size);
  for (Rows& rows : blocks) {
    std::copy(rows.i.begin(), rows.i.end(), q.i.begin() + std::ptrdiff_t(rows.start));
    std::copy(rows.j.begin(), rows.j.end(), q.j.begin() + std::ptrdiff_t(rows.start));
  }
  const Sorter sort(blocks, size, threads);
  std::vector<Index> spare_index;
  sort(q.bond, spare_index);
  std::vector<BondState> spare_state;
  sort(q.state, spare_state);
  std::vector<double> spare;
  sort(q.rest_length, spare);
  q.columns.resize(law.columns());
  for (auto& column : q.columns) sort(column, spare);
  q.force.resize(size);
  if (law.has_moments()) q.moment.resize(size, Vec3::Zero());
}

/// The farthest from where the strain of the space alone would have taken it, all but a motion in common.
double largest_against(const State& s, const std::vector<Vec3>& from, const Cell& cell, RankLink* link) {
  const Mat3 growth = Mat3::Identity() + (s.cell.vectors() - cell.vectors()) * cell.inverse();
  const auto x = s.particles.position();
  const Particles& p = s.particles;
  std::vector<ExactSum> sums(4);
  for (int c = 0; c < 3; ++c)
    add_block_by_block(p, sums[std::size_t(c)], [&](std::size_t k) { return x[k][c] - (growth * from[k])[c]; });
  sums[3].add(double(p.end_own() - p.first_own()));
  const std::vector<double> all = totals(sums, link);
  const Vec3 mean = Vec3(all[0], all[1], all[2]) / all[3];
  double most = 0;
  for (std::size_t k = p.first_own(); k < p.end_own(); ++k)
    most = std::max(most, (x[k] - growth * from[k] - mean).squaredNorm());
  return std::sqrt(largest_of_ranks(link, most));
}

}  // namespace

void rebuild_pairs(State& s, const Interactions& law, double skin, int threads) {
  const Particles& p = s.particles;
  const Index n = Index(p.size());
  Pairs& q = s.pairs;
  const auto old_start = rows_by_first(q.i, n);
  const auto bond_start = rows_by_first(s.bonds.i, n);
  const NeighbourSearch search(s, p, skin);

  std::vector<Rows> blocks((n + Rows::particles - 1) / Rows::particles);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Rows& rows = blocks[b];
    std::vector<Index> partners;
    Memory memory(s, q, law);
    for (Index i = Index(b * Rows::particles); i < std::min<std::size_t>(p.end_own(), (b + 1) * Rows::particles); ++i) {
      partners.clear();
      search.append_partners(i, partners);
      for (std::size_t k = bond_start[i]; k < bond_start[i + 1]; ++k)
        if (s.bonds.state[k] == BondState::intact || distance(s, i, s.bonds.j[k]) < s.bonds.initial_distance[k] + skin)
          partners.push_back(s.bonds.j[k]);
      for (std::size_t k = old_start[i]; k < old_start[i + 1]; ++k)
        if (distance(s, i, q.j[k]) >= p.radius()[i] + p.radius()[q.j[k]] + skin && memory.holds(k))
          partners.push_back(q.j[k]);
      if (!p.own(i)) std::erase_if(partners, [&](Index j) { return !p.own(j); });
      std::sort(partners.begin(), partners.end());
      partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
      std::size_t at = old_start[i];
      for (const Index j : partners) {
        while (at < old_start[i + 1] && q.j[at] < j) ++at;
        const bool known = at < old_start[i + 1] && q.j[at] == j;
        rows.i.push_back(i);
        rows.j.push_back(j);
        rows.from.push_back(known ? Index(at) : Rows::fresh);
      }
    }
  }
  std::size_t size = 0;
  for (Rows& rows : blocks) {
    rows.start = size;
    size += rows.i.size();
  }
  BRECCIA_ASSERT(size < (std::size_t(1) << 31));
  take_over(q, blocks, size, law, threads);
  std::fill(s.bonds.pair.begin(), s.bonds.pair.end(), BondsView::no_pair);
  std::vector<double*> columns;
  const PairBatch all = whole_batch(s, columns);

#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Rows& rows = blocks[b];
    const std::size_t start = rows.start, count = rows.i.size();
    std::size_t first_new = start;  // of a run of new pairs: the law is asked once for each run
    const auto begin_history = [&](std::size_t end) {
      PairBatch run = all;
      run.begin = first_new;
      run.end = end;
      if (first_new < end) law.initialise(run);
    };
    for (std::size_t r = 0; r < count; ++r) {
      const Index i = rows.i[r], j = rows.j[r];
      const std::size_t k = start + r;
      if (rows.from[r] != Rows::fresh) {
        begin_history(k);
        first_new = k + 1;
      } else {
        const auto begin = s.bonds.j.begin() + std::ptrdiff_t(bond_start[i]),
                   end = s.bonds.j.begin() + std::ptrdiff_t(bond_start[i + 1]);
        const auto at = std::lower_bound(begin, end, j);
        const bool bonded = at != end && *at == j;  // or was once: its bond knows
        q.bond[k] = bonded ? Index(at - s.bonds.j.begin()) : PairsView::no_bond;
        q.state[k] = bonded ? s.bonds.state[q.bond[k]] : BondState::unbonded;
        q.rest_length[k] =
            bonded ? s.bonds.initial_distance[q.bond[k]] : std::min(distance(s, i, j), p.radius()[i] + p.radius()[j]);
      }
      if (q.bond[k] != PairsView::no_bond) s.bonds.pair[q.bond[k]] = Index(k);
    }
    begin_history(start + count);
  }
  s.positions_at_rebuild.assign(p.position().begin(), p.position().end());
  s.cell_at_rebuild = s.cell;
  s.moved_bound = s.walls_moved = s.strained = 0;
}

Incidence make_incidence(const State& s, int threads) {
  const Pairs& q = s.pairs;
  const std::size_t n = s.particles.size(), t = std::size_t(threads);
  Incidence in;
  in.start.assign(n + 1, 0);
  in.entry.resize(2 * q.size());
  // Counting sort: each thread has its part of the pairs, and its places within each particle's come after those of the
  // threads before it.
  std::vector<Index> place(t * n, 0);
  const auto part = [&](std::size_t k) { return q.size() * k / t; };
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (std::size_t k = 0; k < t; ++k)
    for (std::size_t r = part(k); r < part(k + 1); ++r) {
      ++place[k * n + q.i[r]];
      ++place[k * n + q.j[r]];
    }
  Index before = 0;
  for (std::size_t a = 0; a < n; ++a) {
    in.start[a] = before;
    for (std::size_t k = 0; k < t; ++k) before += std::exchange(place[k * n + a], before);
  }
  in.start[n] = before;
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (std::size_t k = 0; k < t; ++k)
    for (std::size_t r = part(k); r < part(k + 1); ++r) {
      in.entry[place[k * n + q.i[r]]++] = Index(2 * r);
      in.entry[place[k * n + q.j[r]]++] = Index(2 * r + 1);
    }
  return in;
}

double largest_displacement(const State& s, const std::vector<Vec3>& from, const Cell& cell, int threads,
                            RankLink* link) {
  if (s.cell.vectors() != cell.vectors()) return largest_against(s, from, cell, link);
  double most = 0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : most)
  for (std::size_t k = s.particles.first_own(); k < s.particles.end_own(); ++k)
    most = std::max(most, (s.particles.position()[k] - from[k]).squaredNorm());
  return std::sqrt(largest_of_ranks(link, most));
}

}  // namespace breccia
