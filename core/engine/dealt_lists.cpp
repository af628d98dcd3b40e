// SPDX-License-Identifier: BSD-3-Clause
#include "engine/dealt_lists.hpp"

namespace breccia {

PackingOrder::PackingOrder(const Parts& parts, const Particles& p)
    : parts_(parts), slabs_(parts.rows(), parts.link().ranks()), of_rank_(std::size_t(parts.link().ranks())) {
  for (std::size_t a = p.first_own(); a < p.end_own(); ++a) own_.emplace_back(p.id[a], Index(a - p.first_own()));
  std::sort(own_.begin(), own_.end());
  std::vector<std::vector<std::pair<Index, Index>>> to(ranks());  // number and row
  for (const auto& [id, at] : own_) to[std::size_t(slabs_.owner(id))].emplace_back(id, Index(parts.first_row() + at));
  const ListShare slab = own_slab();
  row_.resize(slab.rows);
  const auto got = received(parts.link(), to);
  for (std::size_t r = 0; r < got.size(); ++r)
    for (const auto& [id, row] : got[r]) {
      of_rank_[r].push_back(Index(id - slab.first));
      row_[id - slab.first] = row;
    }
}

std::vector<Index> PackingOrder::rows_of(const std::vector<Index>& ids) const {
  const bool wrong = std::any_of(ids.begin(), ids.end(), [&](Index id) { return id >= slabs_.total(); });
  if (parts_.link().any(wrong)) throw UserError("the checkpoint names particles that there are not");
  return at_places(parts_.link(), std::vector<std::size_t>(ids.begin(), ids.end()), row_, slabs_);
}

ListDeal::ListDeal(const Parts& parts, std::initializer_list<const std::vector<Index>*> rows, std::size_t total)
    : link_(&parts.link()), total_(total), take_(std::size_t(parts.link().ranks())) {
  const std::size_t records = (*rows.begin())->size();
  for (Index k = 0; k < records; ++k) {
    int before = -1;
    for (const std::vector<Index>* const of : rows) {
      const int owner = parts.owner((*of)[k]);
      if (owner != before) take_[std::size_t(owner)].push_back(k);
      before = owner;
    }
  }
}

}  // namespace breccia
