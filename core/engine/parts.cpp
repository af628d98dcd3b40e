// SPDX-License-Identifier: BSD-3-Clause
#include "engine/parts.hpp"

#include <algorithm>
#include <numeric>

#include "breccia/error.hpp"
#include "engine/chunks.hpp"
#include "engine/exact_sum.hpp"
#include "engine/rows_of_state.hpp"

namespace breccia {

std::size_t first_counted(const std::vector<Index>& i, const Particles& p) {
  return std::size_t(std::lower_bound(i.begin(), i.end(), Index(p.first_own())) - i.begin());
}

std::vector<Index> as_rows(const std::vector<Index>& of, std::size_t from, const Particles& p) {
  std::vector<Index> rows(of.begin() + std::ptrdiff_t(from), of.end());
  for (Index& k : rows) k = p.row_of(k);
  return rows;
}

std::vector<Index> shares_of_ranks(std::span<const double> weights, std::size_t rows, int of_ranks) {
  const std::size_t blocks = weights.size(), ranks = std::size_t(of_ranks);
  if (blocks < ranks)
    throw UserError("there are more ranks than work: " + std::to_string(rows) + " particles make " +
                    std::to_string(blocks) + " block" + (blocks == 1 ? "" : "s") + " of " +
                    std::to_string(particle_block) + ", and each of the " + std::to_string(ranks) +
                    " ranks needs one; start at most " + std::to_string(blocks) + " (mpirun -n)");
  std::vector<double> weight(blocks + 1, 0.0);
  std::partial_sum(weights.begin(), weights.end(), weight.begin() + 1);
  std::vector<Index> first(ranks + 1, Index(rows));
  std::size_t block = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    first[r] = Index(block * particle_block);
    ++block;
    const double share = weight.back() * double(r + 1) / double(ranks);
    while (blocks - block >= ranks - r && weight[block + 1] + weight[block] <= 2 * share) ++block;
  }
  return first;
}

std::vector<Index> even_shares(std::size_t rows, int ranks) {
  std::vector<double> weights;
  for (std::size_t first = 0; first < rows; first += particle_block)
    weights.push_back(double(std::min(particle_block, rows - first)));
  return shares_of_ranks(weights, rows, ranks);
}

/// Before or after the lists are of that length.
void Parts::stand(Particles& p, const std::vector<Index>& rows) {
  const auto at = [&](Index row) {
    return std::size_t(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
  };
  const std::size_t first = at(first_row()), end = at(end_row());
  p.row = rows;
  p.copies_before = first;
  p.copies_behind = rows.size() - end;
  RankLink::Copies copies{first, end - first, {}, {}, {}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k >= first && k < end) continue;
    copies.at.push_back(Index(k));
    copies.owner.push_back(owner(rows[k]));
    copies.in_owner.push_back(rows[k] - first_row(copies.owner.back()));
  }
  link_->follow(copies);
}

void Parts::begin(State& s) {
  BRECCIA_ASSERT(s.pairs.size() == 0 && s.bonds.size() == 0 && s.wall_touches.empty());
  if (s.particles.row.empty()) {
    first_row_ = even_shares(s.particles.size(), link_->ranks());
    std::vector<Index> own;
    for (Index a = first_row(); a < end_row(); ++a) own.push_back(a);
    for_each_particle_array([&](auto& array) { pick(array, own); }, s);
    stand(s.particles, own);
    return;
  }
  first_row_ = {0};
  for (const std::size_t own : link_->numbers_of_all(s.particles.size()))
    first_row_.push_back(Index(first_row_.back() + own));
  stand(s.particles, std::vector<Index>(s.particles.row));
}

std::size_t Parts::before(std::size_t own) const {
  const auto of_all = link_->numbers_of_all(own);
  return std::accumulate(of_all.begin(), of_all.begin() + link_->rank(), std::size_t(0));
}

void Parts::note_crack(const State& s, Index bond) {
  const Particles& p = s.particles;
  crack_keys_.push_back({s.step + 1, std::uint64_t(p.row_of(s.bonds.i[bond])) << 32 | p.row_of(s.bonds.j[bond])});
}

State Parts::whole(State& s, bool everywhere) const {
  // All that is no list of particles, pairs or bonds is the same on all ranks: copied without them.
  State lists;
  swap_lists(s, lists);
  State w = s;
  swap_lists(s, lists);
  const Particles& p = s.particles;
  for_each_particle_array([&](auto& own, auto& all) { all = gathered_rows(own, p, everywhere); }, s, w);
  const Bonds& b = s.bonds;
  w.bonds.i = gathered(as_rows(b.i, first_counted(b.i, p), p), everywhere);
  w.bonds.j = gathered(as_rows(b.j, first_counted(b.i, p), p), everywhere);
  for_each_bond_array(
      [&]<class T>(const std::vector<T>& own, std::vector<T>& all) {
        if (!link_->any(!own.empty())) return;
        const std::size_t from = first_counted(b.i, p);
        all = own.empty() ? gathered(std::vector<T>(b.size() - from), everywhere)
                          : gathered(std::span<const T>(own).subspan(from), everywhere);
      },
      s.bonds, w.bonds);
  w.bonds.pair.assign(w.bonds.i.size(), BondsView::no_pair);
  const std::size_t first_pair = first_counted(s.pairs.i, p), first_bond = first_counted(s.bonds.i, p);
  w.pairs.columns.resize(s.pairs.columns.size());
  for_each_pair_array(
      [&]<class T>(const std::vector<T>& own, std::vector<T>& all) {
        if (link_->any(!own.empty()))
          all = gathered(std::span<const T>(own).subspan(std::min(own.size(), first_pair)), everywhere);
      },
      s.pairs, w.pairs);
  w.pairs.i = gathered(as_rows(s.pairs.i, first_pair, p), everywhere);
  w.pairs.j = gathered(as_rows(s.pairs.j, first_pair, p), everywhere);
  // Bonds that are counted here stand behind those of the ranks before.
  const std::size_t bonds_before = before(s.bonds.size() - first_bond);
  std::vector<Index> bond(s.pairs.bond.begin() + std::ptrdiff_t(first_pair), s.pairs.bond.end());
  for (Index& k : bond)
    if (k != PairsView::no_bond) k = Index(k - first_bond + bonds_before);
  w.pairs.bond = gathered(bond, everywhere);
  for (Index k = 0; k < w.pairs.bond.size(); ++k)
    if (const Index at = w.pairs.bond[k]; at != PairsView::no_bond) w.bonds.pair[at] = k;
  w.bonds.cracks = cracks(s.bonds, p, w.bonds.crack_of, everywhere);
  std::vector<WallTouch> touches = s.wall_touches;
  for (WallTouch& t : touches) t.particle = p.row_of(t.particle);
  w.wall_touches = gathered(touches, everywhere);
  std::stable_sort(w.wall_touches.begin(), w.wall_touches.end(),
                   [](const WallTouch& t, const WallTouch& u) { return t.wall < u.wall; });
  return w;
}

Parts::CrackPlaces Parts::crack_places(const Bonds& bonds, const Particles& p) const {
  CrackPlaces found;
  std::vector<CrackKey> own;
  for (std::size_t b = first_counted(bonds.i, p); b < bonds.size(); ++b)
    if (const Index c = bonds.crack_of[b]; c != BondsView::no_crack) {
      found.bond.push_back(b);
      own.push_back(crack_keys_[c]);
    }
  const auto before = [](const CrackKey& a, const CrackKey& b) {
    return a.step != b.step ? a.step < b.step : a.place < b.place;
  };
  std::vector<CrackKey> all = gathered(own, true);
  std::sort(all.begin(), all.end(), before);
  for (const CrackKey& key : own)
    found.place.push_back(std::size_t(std::lower_bound(all.begin(), all.end(), key, before) - all.begin()));
  found.total = all.size();
  return found;
}

/// Those of the whole in the order in which they came, on the first rank or everywhere, with the bonds they are of.
std::vector<Crack> Parts::cracks(const Bonds& bonds, const Particles& p, std::vector<Index>& crack_of,
                                 bool everywhere) const {
  struct Broken {
    std::size_t place, bond;
    Crack crack;
  };
  const std::size_t first = first_counted(bonds.i, p), counted = bonds.size() - first, bonds_before = before(counted);
  const CrackPlaces own = crack_places(bonds, p);
  std::vector<Broken> broken;
  for (std::size_t k = 0; k < own.bond.size(); ++k)
    broken.push_back({own.place[k], own.bond[k] - first + bonds_before, bonds.cracks[bonds.crack_of[own.bond[k]]]});
  broken = gathered(broken, everywhere);
  const std::vector<std::size_t> of_all = link_->numbers_of_all(counted);
  crack_of.assign(everywhere || link_->first() ? std::accumulate(of_all.begin(), of_all.end(), std::size_t(0)) : 0,
                  BondsView::no_crack);
  std::vector<Crack> all(broken.size());
  for (const Broken& b : broken) {
    crack_of[b.bond] = Index(b.place);
    all[b.place] = b.crack;
  }
  return all;
}

double Parts::imbalance(const State& s) const {
  const std::size_t pairs = s.pairs.size() - first_counted(s.pairs.i, s.particles);
  const double mine = double(pairs + s.particles.end_own() - s.particles.first_own());
  std::vector<ExactSum> sum(1);
  sum[0].add(mine);
  return link_->largest_of(mine) * double(link_->ranks()) / totals(sum, link_)[0] - 1;
}

}  // namespace breccia
