// SPDX-License-Identifier: BSD-3-Clause
#include "engine/parts.hpp"

#include <algorithm>
#include <numeric>

#include "breccia/error.hpp"
#include "engine/chunks.hpp"
#include "engine/exact_sum.hpp"
#include "engine/rows_of_state.hpp"

namespace breccia {
namespace {

constexpr Index none = 0xffffffffu;

/// Bonds, or contacts, of which an own particle is one.
std::vector<Index> touching(const std::vector<Index>& i, const std::vector<Index>& j, Index first, Index end) {
  std::vector<Index> rows;
  for (Index k = 0; k < i.size(); ++k)
    if ((i[k] >= first && i[k] < end) || (j[k] >= first && j[k] < end)) rows.push_back(k);
  return rows;
}

void rename(std::vector<Index>& of, const std::vector<Index>& to) {
  for (Index& k : of)
    if (k != none) k = to[k];
}

std::vector<Index> inverse(const std::vector<Index>& rows, std::size_t size) {
  std::vector<Index> to(size, none);
  for (Index k = 0; k < rows.size(); ++k) to[rows[k]] = k;
  return to;
}

std::vector<Index> as_rows(const std::vector<Index>& of, std::size_t from, const Particles& p) {
  std::vector<Index> rows(of.begin() + std::ptrdiff_t(from), of.end());
  for (Index& k : rows) k = p.row_of(k);
  return rows;
}

}  // namespace

std::size_t first_counted(const std::vector<Index>& i, const Particles& p) {
  return std::size_t(std::lower_bound(i.begin(), i.end(), Index(p.first_own())) - i.begin());
}

/// Blocks weigh as much as they have particles and pairs, or bonds where pairs are not known yet.
void Parts::deal(const State& s) {
  const std::size_t n = s.particles.size(), blocks = (n + particle_block - 1) / particle_block,
                    ranks = std::size_t(link_->ranks());
  if (blocks < ranks)
    throw UserError("there are more ranks than work: " + std::to_string(n) + " particles make " +
                    std::to_string(blocks) + " block" + (blocks == 1 ? "" : "s") + " of " +
                    std::to_string(particle_block) + ", and each of the " + std::to_string(ranks) +
                    " ranks needs one; start at most " + std::to_string(blocks) + " (mpirun -n)");
  std::vector<double> weight(blocks + 1, 0.0);
  for (std::size_t a = 0; a < n; ++a) weight[a / particle_block + 1] += 1;
  for (const Index i : s.pairs.size() ? s.pairs.i : s.bonds.i) weight[i / particle_block + 1] += 1;
  std::partial_sum(weight.begin(), weight.end(), weight.begin());
  const std::vector<Index> before = std::move(first_row_);
  first_row_.assign(ranks + 1, Index(n));
  std::size_t block = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    first_row_[r] = Index(block * particle_block);
    ++block;
    const double share = weight.back() * double(r + 1) / double(ranks);
    while (blocks - block >= ranks - r && weight[block + 1] + weight[block] <= 2 * share) ++block;
  }
  if (!before.empty() && before != first_row_) ++changes_;
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
    const auto owner = std::upper_bound(first_row_.begin(), first_row_.end(), rows[k]) - first_row_.begin() - 1;
    copies.at.push_back(Index(k));
    copies.owner.push_back(int(owner));
    copies.in_owner.push_back(rows[k] - first_row(int(owner)));
  }
  link_->follow(copies);
}

void Parts::cut(State& s, Bonds& contacts) {
  BRECCIA_ASSERT(!parted_ && s.particles.row.empty());
  deal(s);
  const Index first = first_row(), end = end_row();
  const std::vector<Index> pairs = touching(s.pairs.i, s.pairs.j, first, end),
                           bonds = touching(s.bonds.i, s.bonds.j, first, end),
                           others = touching(contacts.i, contacts.j, first, end);
  std::vector<std::uint8_t> wanted(s.particles.size());
  std::fill(wanted.begin() + first, wanted.begin() + end, 1);
  const auto want = [&](const std::vector<Index>& i, const std::vector<Index>& j, const std::vector<Index>& rows) {
    for (const Index k : rows) wanted[i[k]] = wanted[j[k]] = 1;
  };
  want(s.pairs.i, s.pairs.j, pairs);
  want(s.bonds.i, s.bonds.j, bonds);
  want(contacts.i, contacts.j, others);
  std::vector<Index> rows;
  for (Index a = 0; a < wanted.size(); ++a)
    if (wanted[a]) rows.push_back(a);
  const std::vector<Index> here = inverse(rows, wanted.size()), pair_here = inverse(pairs, s.pairs.size()),
                           bond_here = inverse(bonds, s.bonds.size());

  for_each_particle_array([&](auto& array) { pick(array, rows); }, s);
  for_each_pair_array([&](auto& array) { pick(array, pairs); }, s.pairs);
  for (auto* of : {&s.pairs.i, &s.pairs.j, &s.pairs.bond}) pick(*of, pairs);
  for (auto* of : {&s.pairs.i, &s.pairs.j}) rename(*of, here);
  rename(s.pairs.bond, bond_here);

  std::vector<std::uint8_t> cracked(s.bonds.cracks.size());
  for (const Index b : bonds)
    if (s.bonds.crack_of[b] != BondsView::no_crack) cracked[s.bonds.crack_of[b]] = 1;
  std::vector<Index> cracks;
  for (Index c = 0; c < cracked.size(); ++c)
    if (cracked[c]) cracks.push_back(c);
  const std::vector<Index> crack_here = inverse(cracks, cracked.size());
  crack_keys_.clear();
  for (const Index c : cracks) crack_keys_.push_back({0, c});
  pick(s.bonds.cracks, cracks);
  const auto keep = [&](Bonds& of, const std::vector<Index>& kept) {
    for_each_bond_array([&](auto& array) { pick(array, kept); }, of);
    for (auto* array : {&of.i, &of.j, &of.pair, &of.crack_of}) pick(*array, kept);
    for (auto* array : {&of.i, &of.j}) rename(*array, here);
  };
  keep(s.bonds, bonds);
  rename(s.bonds.crack_of, crack_here);
  rename(s.bonds.pair, pair_here);
  keep(contacts, others);

  std::erase_if(s.wall_touches, [&](const WallTouch& t) { return t.particle < first || t.particle >= end; });
  for (WallTouch& t : s.wall_touches) t.particle = here[t.particle];
  stand(s.particles, rows);
  parted_ = true;
}

void Parts::note_crack(const State& s, Index bond) {
  const Particles& p = s.particles;
  crack_keys_.push_back({s.step + 1, std::uint64_t(p.row_of(s.bonds.i[bond])) << 32 | p.row_of(s.bonds.j[bond])});
}

Bonds Parts::whole(const Bonds& b, const Particles& p, bool everywhere) const {
  const std::size_t from = first_counted(b.i, p);
  Bonds w;
  w.i = gathered(std::span<const Index>(as_rows(b.i, from, p)), everywhere);
  w.j = gathered(std::span<const Index>(as_rows(b.j, from, p)), everywhere);
  const auto take = [&]<class T>(const std::vector<T>& of) {
    return gathered(std::span<const T>(of).subspan(from), everywhere);
  };
  w.initial_distance = take(b.initial_distance);
  w.state = take(b.state);
  if (link_->any(!b.guarded.empty())) w.guarded = take(b.guarded);
  if (link_->any(!b.released.empty()))
    w.released = take(b.released.empty() ? std::vector<double>(b.size(), 0.0) : b.released);
  w.pair.assign(w.i.size(), BondsView::no_pair);
  w.crack_of.assign(w.i.size(), BondsView::no_crack);
  return w;
}

State Parts::whole(State& s, bool everywhere) const {
  BRECCIA_ASSERT(parted_);
  // All that is no list of particles, pairs or bonds is the same on all ranks: copied without them.
  State lists;
  swap_lists(s, lists);
  State w = s;
  swap_lists(s, lists);
  const Particles& p = s.particles;
  for_each_particle_array([&](auto& own, auto& all) { all = gathered_rows(own, p, everywhere); }, s, w);
  w.bonds = whole(s.bonds, p, everywhere);
  const std::size_t first_pair = first_counted(s.pairs.i, p), first_bond = first_counted(s.bonds.i, p);
  w.pairs.columns.resize(s.pairs.columns.size());
  for_each_pair_array(
      [&]<class T>(const std::vector<T>& own, std::vector<T>& all) {
        if (link_->any(!own.empty()))
          all = gathered(std::span<const T>(own).subspan(std::min(own.size(), first_pair)), everywhere);
      },
      s.pairs, w.pairs);
  w.pairs.i = gathered(std::span<const Index>(as_rows(s.pairs.i, first_pair, p)), everywhere);
  w.pairs.j = gathered(std::span<const Index>(as_rows(s.pairs.j, first_pair, p)), everywhere);
  // Bonds and pairs that are counted here stand behind those of the ranks before.
  const auto bonds_of = link_->numbers_of_all(s.bonds.size() - first_bond);
  const auto before = std::accumulate(bonds_of.begin(), bonds_of.begin() + link_->rank(), std::size_t(0));
  std::vector<Index> bond(s.pairs.bond.begin() + std::ptrdiff_t(first_pair), s.pairs.bond.end());
  for (Index& b : bond)
    if (b != PairsView::no_bond) b = Index(b - first_bond + before);
  w.pairs.bond = gathered(std::span<const Index>(bond), everywhere);
  for (Index k = 0; k < w.pairs.bond.size(); ++k)
    if (const Index b = w.pairs.bond[k]; b != PairsView::no_bond) w.bonds.pair[b] = k;

  struct Broken {
    CrackKey key;
    Index bond;
    Crack crack;
  };
  std::vector<Broken> broken;
  for (std::size_t b = first_bond; b < s.bonds.size(); ++b)
    if (const Index c = s.bonds.crack_of[b]; c != BondsView::no_crack)
      broken.push_back({crack_keys_[c], Index(b - first_bond + before), s.bonds.cracks[c]});
  broken = gathered(std::span<const Broken>(broken), everywhere);
  std::sort(broken.begin(), broken.end(), [](const Broken& a, const Broken& b) {
    return a.key.step != b.key.step ? a.key.step < b.key.step : a.key.place < b.key.place;
  });
  for (const Broken& b : broken) {
    w.bonds.crack_of[b.bond] = Index(w.bonds.cracks.size());
    w.bonds.cracks.push_back(b.crack);
  }
  std::vector<WallTouch> touches = s.wall_touches;
  for (WallTouch& t : touches) t.particle = p.row_of(t.particle);
  w.wall_touches = gathered(std::span<const WallTouch>(touches), everywhere);
  std::stable_sort(w.wall_touches.begin(), w.wall_touches.end(),
                   [](const WallTouch& a, const WallTouch& b) { return a.wall < b.wall; });
  return w;
}

void Parts::renew_copies(State& s, Bonds& contacts, double skin) {
  Particles& p = s.particles;
  const std::size_t ranks = std::size_t(link_->ranks()), own = p.end_own() - p.first_own();
  // Those that own pairs and bonds meet are asked for; their owners know who else is near.
  std::vector<std::uint8_t> met(p.size());
  for (const auto* of : {&s.pairs.i, &s.pairs.j, &s.bonds.i, &s.bonds.j, &contacts.i, &contacts.j})
    for (const Index a : *of) met[a] = 1;
  std::vector<std::vector<Index>> asked(ranks);
  for (std::size_t a = 0, r = 0; a < p.size(); ++a) {
    while (p.row[a] >= first_row_[r + 1]) ++r;
    if (met[a] && !p.own(a)) asked[r].push_back(p.row[a]);
  }
  const auto given = rows_for_others(s, std::move(asked), skin);
  std::vector<Index> rows;
  for (std::size_t r = 0; r < ranks; ++r)
    if (int(r) != link_->rank()) rows.insert(rows.end(), given[r].begin(), given[r].end());
    else
      for (Index a = first_row(); a < end_row(); ++a) rows.push_back(a);

  const std::vector<Index> old = p.row;
  const std::size_t old_first = p.first_own();
  std::vector<Index> there(old.size(), none);
  for (std::size_t a = 0, k = 0; a < old.size(); ++a) {
    while (k < rows.size() && rows[k] < old[a]) ++k;
    if (k < rows.size() && rows[k] == old[a]) there[a] = Index(k);
  }
  stand(p, rows);
  for_each_particle_array(
      [&]<class T>(std::vector<T>& array) {
        if (array.empty()) return;
        std::vector<T> now(rows.size());
        std::copy_n(array.begin() + std::ptrdiff_t(old_first), own, now.begin() + std::ptrdiff_t(p.copies_before));
        array.swap(now);
        link_->forward(array);
      },
      s);
  for (auto* of : {&s.pairs.i, &s.pairs.j, &s.bonds.i, &s.bonds.j, &contacts.i, &contacts.j}) rename(*of, there);
  for (WallTouch& t : s.wall_touches) t.particle = there[t.particle];
}

std::vector<std::vector<Index>> Parts::rows_for_others(const State& s, std::vector<std::vector<Index>> asked,
                                                       double skin) const {
  const auto sent = [&](const std::vector<std::vector<Index>>& rows) {
    std::vector<std::vector<std::byte>> to(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto bytes = std::as_bytes(std::span(rows[r]));
      to[r].assign(bytes.begin(), bytes.end());
    }
    std::vector<std::vector<Index>> got(rows.size());
    const auto from = link_->exchange(to);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      got[r].resize(from[r].size() / sizeof(Index));
      std::copy(from[r].begin(), from[r].end(), reinterpret_cast<std::byte*>(got[r].data()));
    }
    return got;
  };
  const std::vector<BlockBox> own = boxes_of_blocks(s.particles);
  const std::vector<BlockBox> all = gathered(std::span<const BlockBox>(own), true);
  const auto wanted = sent(asked);
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
  return sent(give);
}

double Parts::imbalance(const State& s) const {
  const std::size_t pairs = s.pairs.size() - first_counted(s.pairs.i, s.particles);
  const double mine = double(pairs + s.particles.end_own() - s.particles.first_own());
  std::vector<ExactSum> sum(1);
  sum[0].add(mine);
  return link_->largest_of(mine) * double(link_->ranks()) / totals(sum, link_)[0] - 1;
}

}  // namespace breccia
