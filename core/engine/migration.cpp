// SPDX-License-Identifier: BSD-3-Clause
#include "engine/migration.hpp"

#include <algorithm>
#include <numeric>

namespace breccia {

PairMigration::PairMigration(const Migration& move, const std::vector<Index>& from_i, const std::vector<Index>& from_j)
    : move_(move), size_before_(from_i.size()), take_(move.ranks()) {
  const auto own = [&](Index row) { return row >= move.first_before() && row < move.end_before(); };
  for (Index k = 0; k < from_i.size(); ++k) {
    const int a = own(from_i[k]) ? move.owner(from_i[k]) : -1, b = own(from_j[k]) ? move.owner(from_j[k]) : -1;
    if (a >= 0) take_[std::size_t(a)].push_back(k);
    if (b >= 0 && b != a) take_[std::size_t(b)].push_back(k);
  }
  const auto gone = [&](const std::vector<Index>& of) {
    std::vector<std::vector<Index>> to(take_.size());
    for (std::size_t r = 0; r < to.size(); ++r)
      for (const Index k : take_[r]) to[r].push_back(of[k]);
    return sent(move.link(), to);
  };
  const std::vector<Index> all_i = gone(from_i), all_j = gone(from_j);
  kept_.resize(all_i.size());
  std::iota(kept_.begin(), kept_.end(), Index(0));
  const auto same = [&](Index a, Index b) { return all_i[a] == all_i[b] && all_j[a] == all_j[b]; };
  std::sort(kept_.begin(), kept_.end(), [&](Index a, Index b) {
    if (!same(a, b)) return all_i[a] != all_i[b] ? all_i[a] < all_i[b] : all_j[a] < all_j[b];
    return a < b;
  });
  kept_.erase(std::unique(kept_.begin(), kept_.end(), same), kept_.end());
  for (const Index k : kept_) {
    i.push_back(all_i[k]);
    j.push_back(all_j[k]);
  }
}

}  // namespace breccia
