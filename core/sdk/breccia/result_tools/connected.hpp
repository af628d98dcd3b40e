// SPDX-License-Identifier: BSD-3-Clause
/// Bodies: what intact bonds hold together, of a specimen or of all its parts.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "breccia/block_sum.hpp"

namespace breccia {

/// One of them, or a single particle.
struct Body {
  Index first = 0;         ///< the lowest number in the packing
  std::uint32_t size = 0;  ///< particles
  std::int64_t mass = 0;   ///< in units that are the same for all of a specimen
};

struct Bodies {
  std::vector<Index> of;     ///< per particle of the view: `Body::first` of that which it belongs to
  std::vector<Body> here;    ///< those that lie wholly in this part, by `first`
  std::vector<Body> shared;  ///< those that go on in other parts: all of each, the same in all parts, by `first`
};

namespace connected_detail {

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
      for (const Index one : {a, b}) lower_.try_emplace(one, one);
      lower_[std::max(a, b)] = std::min(a, b);
    }
  }
  bool knows(Index a) const { return lower_.contains(a); }
  Index lowest(Index a) {
    Index root = a;
    for (auto at = lower_.find(root); at != lower_.end() && at->second != root; at = lower_.find(root))
      root = at->second;
    while (a != root) a = std::exchange(lower_[a], root);
    return root;
  }

 private:
  std::unordered_map<Index, Index> lower_;  ///< the lowest one leads to itself
};

/// In the order of `first`, with those of the same added up.
inline void add_up(std::vector<Body>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const Body& a, const Body& b) { return a.first < b.first; });
  std::vector<Body> all;
  for (const Body& p : pieces) {
    if (all.empty() || all.back().first != p.first) all.push_back({p.first, 0, 0});
    all.back().size += p.size;
    all.back().mass += p.mass;
  }
  pieces.swap(all);
}

}  // namespace connected_detail

/// Union-find over the intact bonds. Parts tell each other of the bonds between them and of the bodies that these join,
/// and of nothing else; all of them ask together.
inline Bodies find_bodies(const SimulationView& view) {
  using namespace connected_detail;
  const ParticlesView& particles = view.particles;
  const BondsView& bonds = view.bonds;
  const OwnRows own = view.own_particles();
  UnionFind sets(particles.size());
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (bonds.state[b] == BondState::intact) sets.unite(bonds.i[b], bonds.j[b]);
  std::vector<Index> first(particles.size(), Index(-1));  // by root
  for (std::size_t p = 0; p < particles.size(); ++p) {
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
  Bodies bodies;
  bodies.of.resize(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) bodies.of[p] = linked.lowest(first[sets.root(Index(p))]);
  // Masses as whole numbers: sums of them are the same however they are parted.
  BlockSum<double> mass(view);
  for (const std::size_t p : own) mass.add(p, particles.mass[p]);
  const double total = view.sum(mass.exact()), unit = total > 0 ? std::scalbn(1.0, std::ilogb(total) - 60) : 1;
  std::unordered_map<Index, Body> pieces;
  for (const std::size_t p : own) {
    Body& piece = pieces[bodies.of[p]];
    ++piece.size;
    piece.mass += std::llround(particles.mass[p] / unit);
  }
  for (const auto& [lowest, piece] : pieces)
    (linked.knows(lowest) ? bodies.shared : bodies.here).push_back({lowest, piece.size, piece.mass});
  bodies.shared = view.all(bodies.shared);
  for (auto* list : {&bodies.here, &bodies.shared}) add_up(*list);
  return bodies;
}

}  // namespace breccia
