// SPDX-License-Identifier: BSD-3-Clause
// Which particles are where: own ones as work is dealt anew, copies of others as particles move.
#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/chunks.hpp"
#include "engine/parts.hpp"
#include "engine/rows_of_state.hpp"

namespace breccia {
namespace {

constexpr Index none = 0xffffffffu;

/// Of particles and pairs, or bonds where pairs are not known yet; of each own block.
std::vector<double> weights_of_blocks(const State& s) {
  const Particles& p = s.particles;
  const std::size_t first = p.first_own();
  std::vector<double> weight(blocks_of(p), 0.0);
  for (std::size_t a = first; a < p.end_own(); ++a) weight[(a - first) / particle_block] += 1;
  const std::vector<Index>& i = s.pairs.size() ? s.pairs.i : s.bonds.i;
  for (std::size_t k = first_counted(i, p); k < i.size(); ++k) weight[(i[k] - first) / particle_block] += 1;
  return weight;
}

/// Everything that names particles by their place here.
template <class F>
void for_each_list_of_particles(F&& f, State& s, Bonds& contacts) {
  for (auto* of : {&s.pairs.i, &s.pairs.j, &s.bonds.i, &s.bonds.j, &contacts.i, &contacts.j}) f(*of);
}

/// Bonds, but for their cracks, which are few.
void move_bonds(const Migration& move, Bonds& b) {
  PairMigration ends(move, b.i, b.j);
  for_each_bond_array([&](auto& array) { ends(array); }, b);
  b.i.swap(ends.i);
  b.j.swap(ends.j);
  b.pair.assign(b.size(), BondsView::no_pair);
  b.crack_of.assign(b.size(), BondsView::no_crack);
}

void move_pairs(const Migration& move, Pairs& q) {
  // Forces are evaluated anew before anybody looks at them.
  q.force.clear();
  q.moment.clear();
  PairMigration ends(move, q.i, q.j);
  for_each_pair_array([&](auto& array) { ends(array); }, q);
  q.i.swap(ends.i);
  q.j.swap(ends.j);
  q.force.assign(q.size(), PairForce{});
}

}  // namespace

void link_bonds(Pairs& pairs, Bonds& bonds) {
  pairs.bond.assign(pairs.i.size(), PairsView::no_bond);
  bonds.pair.assign(bonds.i.size(), BondsView::no_pair);
  std::size_t b = 0;
  for (std::size_t k = 0; k < pairs.i.size(); ++k) {
    const std::pair ends(pairs.i[k], pairs.j[k]);
    while (b < bonds.i.size() && std::pair(bonds.i[b], bonds.j[b]) < ends) ++b;
    if (b == bonds.i.size() || std::pair(bonds.i[b], bonds.j[b]) != ends) continue;
    pairs.bond[k] = Index(b);
    bonds.pair[b] = Index(k);
  }
}

Migration Parts::deal_again(State& s, Bonds& contacts) {
  Particles& p = s.particles;
  const std::vector<double> weights = gathered(weights_of_blocks(s), true);
  const std::vector<Index> old_rows = p.row,
                           old = std::exchange(first_row_, shares_of_ranks(weights, rows(), link_->ranks()));
  const Migration move(*link_, old, first_row_);
  if (old == first_row_) return move;
  ++changes_;
  const std::size_t old_first = p.first_own(), old_own = p.end_own() - old_first;
  for_each_list_of_particles(
      [&](std::vector<Index>& of) {
        for (Index& k : of) k = old_rows[k];
      },
      s, contacts);
  for (WallTouch& t : s.wall_touches) t.particle = old_rows[t.particle];

  std::vector<Index> crack_i, crack_j;
  std::vector<Crack> cracks;
  std::vector<CrackKey> keys;
  for (std::size_t b = 0; b < s.bonds.size(); ++b) {
    const Index c = s.bonds.crack_of[b];
    if (c == BondsView::no_crack) continue;
    crack_i.push_back(s.bonds.i[b]);
    crack_j.push_back(s.bonds.j[b]);
    cracks.push_back(s.bonds.cracks[c]);
    keys.push_back(crack_keys_[c]);
  }
  const PairMigration cracked(move, crack_i, crack_j);
  cracked(cracks);
  cracked(keys);
  move_bonds(move, s.bonds);
  move_bonds(move, contacts);
  move_pairs(move, s.pairs);
  link_bonds(s.pairs, s.bonds);
  s.bonds.cracks = std::move(cracks);
  crack_keys_ = std::move(keys);
  for (std::size_t b = 0, c = 0; c < cracked.i.size(); ++b) {
    BRECCIA_ASSERT(b < s.bonds.size());
    if (s.bonds.i[b] == cracked.i[c] && s.bonds.j[b] == cracked.j[c]) s.bonds.crack_of[b] = Index(c++);
  }
  s.wall_touches = move.by_row(s.wall_touches, [](const WallTouch& t) { return t.particle; });
  std::stable_sort(s.wall_touches.begin(), s.wall_touches.end(),
                   [](const WallTouch& a, const WallTouch& b) { return a.wall < b.wall; });
  for_each_particle_array(
      [&]<class T>(std::vector<T>& array) {
        if (!array.empty()) array = move.rows(std::span<const T>(array).subspan(old_first, old_own));
      },
      s);
  // For now the own ones are all there are; the rest of their pairs gets its place.
  p.row.clear();
  std::vector<Index> met;
  for (Index a = first_row(); a < end_row(); ++a) {
    p.row.push_back(a);
    met.push_back(a);
  }
  p.copies_before = p.copies_behind = 0;
  for_each_list_of_particles([&](const std::vector<Index>& of) { met.insert(met.end(), of.begin(), of.end()); }, s,
                             contacts);
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  give_places(s, met);
  const auto name = [&](Index row) { return here(p, row); };
  for_each_list_of_particles([&](std::vector<Index>& of) { std::transform(of.begin(), of.end(), of.begin(), name); }, s,
                             contacts);
  for (WallTouch& t : s.wall_touches) t.particle = name(t.particle);
  return move;
}

Index Parts::here(const Particles& p, Index row) {
  const auto at = std::lower_bound(p.row.begin(), p.row.end(), row);
  return at != p.row.end() && *at == row ? Index(at - p.row.begin()) : elsewhere;
}

void Parts::give_places(State& s, const std::vector<Index>& rows) {
  Particles& p = s.particles;
  const std::size_t old_first = p.first_own(), own = p.end_own() - old_first;
  stand(p, rows);
  for_each_particle_array(
      [&]<class T>(std::vector<T>& array) {
        if (array.empty()) return;
        std::vector<T> now(rows.size());
        std::copy_n(array.begin() + std::ptrdiff_t(old_first), own, now.begin() + std::ptrdiff_t(p.copies_before));
        array.swap(now);
      },
      s);
}

void Parts::place(State& s, Bonds& contacts, const std::vector<Index>& rows) {
  const std::vector<Index> old = s.particles.row;
  std::vector<Index> there(old.size(), none);
  for (std::size_t a = 0, k = 0; a < old.size(); ++a) {
    while (k < rows.size() && rows[k] < old[a]) ++k;
    if (k < rows.size() && rows[k] == old[a]) there[a] = Index(k);
  }
  give_places(s, rows);
  for_each_list_of_particles(
      [&](std::vector<Index>& of) {
        for (Index& k : of) k = there[k];
      },
      s, contacts);
  for (WallTouch& t : s.wall_touches) t.particle = there[t.particle];
}

void Parts::renew_copies(State& s, Bonds& contacts, double skin) {
  const Particles& p = s.particles;
  const std::size_t ranks = std::size_t(link_->ranks());
  // Those that own pairs and bonds meet are asked for; their owners know who else is near.
  std::vector<std::uint8_t> met(p.size());
  for_each_list_of_particles(
      [&](const std::vector<Index>& of) {
        for (const Index a : of) met[a] = 1;
      },
      s, contacts);
  std::vector<std::vector<Index>> asked(ranks);
  for (std::size_t a = 0, r = 0; a < p.size(); ++a) {
    while (p.row[a] >= first_row_[r + 1]) ++r;
    if (met[a] && !p.own(a)) asked[r].push_back(p.row[a]);
  }
  // From all ranks in their order, with the own ones where they belong.
  std::vector<Index> rows = rows_of_others(s, asked, skin);
  const auto at = std::lower_bound(rows.begin(), rows.end(), first_row());
  std::vector<Index> own(p.end_own() - p.first_own());
  std::iota(own.begin(), own.end(), first_row());
  rows.insert(at, own.begin(), own.end());
  place(s, contacts, rows);
  for_each_particle_array([&](auto& array) { link_->forward(array); }, s);
}

/// What the others give: what was asked for, and what may come within `skin` of own ones.
std::vector<Index> Parts::rows_of_others(const State& s, const std::vector<std::vector<Index>>& asked,
                                         double skin) const {
  const std::vector<BlockBox> own = boxes_of_blocks(s.particles), all = gathered(own, true);
  const auto wanted = received(*link_, asked);
  std::vector<std::vector<Index>> give(wanted.size());
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    if (int(r) == link_->rank()) continue;
    std::vector<std::uint8_t> near(s.particles.end_own() - s.particles.first_own());
    for (const Index row : wanted[r]) near[row - first_row()] = 1;
    const std::size_t begin = first_row_[r] / particle_block,
                      end = (first_row_[r + 1] + particle_block - 1) / particle_block;
    mark_near(s, own, std::span(all).subspan(begin, end - begin), skin, near);
    for (std::size_t k = 0; k < near.size(); ++k)
      if (near[k]) give[r].push_back(first_row() + Index(k));
  }
  return sent(*link_, give);
}

}  // namespace breccia
