// SPDX-License-Identifier: BSD-3-Clause
#include "fragments.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "breccia/block_sum.hpp"

namespace breccia {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  Index root(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];  // path halving
    return a;
  }
  void unite(Index a, Index b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (size_[a] < size_[b]) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }

 private:
  std::vector<Index> parent_;
  std::vector<std::size_t> size_;
};

/// One fragment, or what a part has of it.
struct Piece {
  Index first = 0;         ///< the lowest number in the packing
  std::uint32_t size = 0;  ///< particles
  std::int64_t mass = 0;   ///< in units that are the same in all parts
};

/// Of two numbers in the packing, that an intact bond joins somewhere.
struct Link {
  Index of, to;
};

/// Sets of numbers in the packing that are linked, by their lowest.
class Linked {
 public:
  explicit Linked(const std::vector<Link>& links) {
    for (const Link& l : links) {
      const Index a = lowest(l.of), b = lowest(l.to);
      if (a != b) lower_[std::max(a, b)] = std::min(a, b);
    }
  }
  Index lowest(Index a) {
    Index root = a;
    for (auto at = lower_.find(root); at != lower_.end(); at = lower_.find(root)) root = at->second;
    while (a != root) a = std::exchange(lower_[a], root);
    return root;
  }

 private:
  std::unordered_map<Index, Index> lower_;
};

}  // namespace

Fragments find_fragments(const SimulationView& view) {
  const ParticlesView& particles = view.particles;
  const BondsView& bonds = view.bonds;
  const OwnRows own = view.own_particles();
  const std::size_t count = particles.size();
  UnionFind sets(count);
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (bonds.state[b] == BondState::intact) sets.unite(bonds.i[b], bonds.j[b]);
  std::vector<Index> first(count, Index(-1));  // by root
  for (std::size_t p = 0; p < count; ++p) {
    Index& lowest = first[sets.root(Index(p))];
    lowest = std::min(lowest, particles.id[p]);
  }
  // What hangs together here may do so by way of other parts: the bonds between them say how.
  std::vector<Link> links;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    const Index i = bonds.i[b], j = bonds.j[b];
    if (bonds.state[b] != BondState::intact || (own.contain(i) && own.contain(j))) continue;
    for (const Index end : {i, j}) links.push_back({particles.id[end], first[sets.root(end)]});
  }
  Linked linked(view.all(links));
  // Masses as whole numbers: sums of them are the same however they are parted.
  BlockSum<double> mass(view);
  for (const std::size_t p : own) mass.add(p, particles.mass[p]);
  const double total = view.sum(mass.exact()), unit = total > 0 ? std::scalbn(1.0, std::ilogb(total) - 60) : 1;
  std::unordered_map<Index, Piece> here;
  for (const std::size_t p : own) {
    const Index lowest = linked.lowest(first[sets.root(Index(p))]);
    Piece& piece = here[lowest];
    piece.first = lowest;
    ++piece.size;
    piece.mass += std::llround(particles.mass[p] / unit);
  }
  std::vector<Piece> pieces;
  for (const auto& [lowest, piece] : here) pieces.push_back(piece);
  pieces = view.all(pieces);
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.first < b.first; });
  std::vector<Piece> all;
  for (const Piece& p : pieces) {
    if (all.empty() || all.back().first != p.first) all.push_back({p.first, 0, 0});
    all.back().size += p.size;
    all.back().mass += p.mass;
  }
  std::stable_sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.mass > b.mass; });

  Fragments f;
  f.count = all.size();
  std::unordered_map<Index, Index> rank;
  std::int64_t of_all = 0;
  for (const Piece& p : all) {
    rank[p.first] = Index(rank.size());
    f.with_company += p.size > 1;
    of_all += p.mass;
  }
  f.of.resize(count);
  for (std::size_t p = 0; p < count; ++p) f.of[p] = rank[linked.lowest(first[sets.root(Index(p))])];
  if (of_all > 0) f.largest_mass_share = double(all[0].mass) / double(of_all);
  return f;
}

}  // namespace breccia
