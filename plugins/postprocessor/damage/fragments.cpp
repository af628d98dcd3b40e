// SPDX-License-Identifier: BSD-3-Clause
#include "fragments.hpp"

#include <algorithm>
#include <numeric>

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
  std::size_t size(Index root) const { return size_[root]; }

 private:
  std::vector<Index> parent_;
  std::vector<std::size_t> size_;
};

}  // namespace

Fragments find_fragments(const ParticlesView& particles, const BondsView& bonds) {
  const std::size_t count = particles.size();
  UnionFind sets(count);
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (bonds.state[b] == BondState::intact) sets.unite(bonds.i[b], bonds.j[b]);

  std::vector<double> mass(count, 0);  // by root
  std::vector<Index> first(count, Index(-1)), roots;
  double total = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const Index r = sets.root(Index(p));
    if (r == p) roots.push_back(r);
    mass[r] += particles.mass[p];
    total += particles.mass[p];
    first[r] = std::min(first[r], particles.id[p]);
  }
  std::sort(roots.begin(), roots.end(),
            [&](Index a, Index b) { return mass[a] != mass[b] ? mass[a] > mass[b] : first[a] < first[b]; });

  Fragments f;
  f.count = roots.size();
  std::vector<Index> rank(count, 0);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    rank[roots[k]] = Index(k);
    f.with_company += sets.size(roots[k]) > 1;
  }
  f.of.resize(count);
  for (std::size_t p = 0; p < count; ++p) f.of[p] = rank[sets.root(Index(p))];
  if (total > 0) f.largest_mass_share = mass[roots[0]] / total;
  return f;
}

}  // namespace breccia
