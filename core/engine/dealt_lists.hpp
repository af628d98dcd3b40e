// SPDX-License-Identifier: BSD-3-Clause
/// How lists of a specimen in parts go between their order in a file and the ranks that own what they tell of. Files
/// are dealt in even slabs; nobody has more than a share of anything.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "breccia/error.hpp"
#include "engine/migration.hpp"
#include "engine/parts.hpp"
#include "engine/shared_lists.hpp"

namespace breccia {

/// Particles by their numbers in the packing, of which each rank keeps a slab: what row each is, and who owns it. All
/// ranks call everything together.
class PackingOrder {
 public:
  PackingOrder(const Parts& parts, const Particles& particles);

  const Slabs& slabs() const { return slabs_; }
  ListShare own_slab() const { return slabs_.of(parts_.link().rank()); }
  /// Of a record for each own particle, in the order of rows, this rank's slab in the order of the packing.
  template <class T>
  std::vector<T> to_slab(const std::vector<T>& own) const {
    std::vector<std::vector<T>> to(ranks());
    for (const auto& [id, at] : own_) to[std::size_t(slabs_.owner(id))].push_back(own[at]);
    const auto got = received(parts_.link(), to);
    std::vector<T> slab(row_.size());
    for (std::size_t r = 0; r < got.size(); ++r)
      for (std::size_t k = 0; k < got[r].size(); ++k) slab[of_rank_[r][k]] = got[r][k];
    return slab;
  }
  /// The other way round.
  template <class T>
  std::vector<T> from_slab(const std::vector<T>& slab) const {
    std::vector<std::vector<T>> to(ranks());
    for (std::size_t r = 0; r < to.size(); ++r)
      for (const Index k : of_rank_[r]) to[r].push_back(slab[k]);
    const std::vector<T> got = sent(parts_.link(), to);  // by number: slabs are, and so are those of one
    std::vector<T> own(own_.size());
    for (std::size_t k = 0; k < got.size(); ++k) own[own_[k].second] = got[k];
    return own;
  }
  /// Rows of the whole. UserError on all ranks when one of them asks for a number that there is not.
  std::vector<Index> rows_of(const std::vector<Index>& ids) const;

 private:
  std::size_t ranks() const { return std::size_t(parts_.link().ranks()); }

  const Parts& parts_;
  Slabs slabs_;
  std::vector<std::pair<Index, Index>> own_;  ///< number in the packing and which of the own rows, by number
  std::vector<Index> row_;                    ///< of each of the slab, row of the whole
  std::vector<std::vector<Index>> of_rank_;   ///< which of the slab each rank owns
};

/// Of a slab that was read, to those that own what its records tell of, each of whom gets them in the order of the
/// whole.
class ListDeal {
 public:
  ListDeal() = default;
  /// Each record goes to the owners of its rows of the whole.
  ListDeal(const Parts& parts, std::initializer_list<const std::vector<Index>*> rows, std::size_t total);

  std::size_t total() const { return total_; }
  template <class T>
  std::vector<T> operator()(const std::vector<T>& slab) const {
    std::vector<std::vector<T>> to(take_.size());
    for (std::size_t r = 0; r < to.size(); ++r)
      for (const Index k : take_[r]) to[r].push_back(slab[k]);
    return sent(*link_, to);
  }

 private:
  RankLink* link_ = nullptr;
  std::size_t total_ = 0;
  std::vector<std::vector<Index>> take_;  ///< for each rank
};

/// Records that have places in a list of the whole: this rank's slab of it.
template <class T>
std::vector<T> by_place(RankLink& link, const std::vector<std::size_t>& places, const std::vector<T>& records,
                        std::size_t total) {
  struct Placed {
    std::size_t place;
    T record;
  };
  const Slabs slabs(total, link.ranks());
  std::vector<std::vector<Placed>> to(std::size_t(link.ranks()));
  for (std::size_t k = 0; k < places.size(); ++k)
    to[std::size_t(slabs.owner(places[k]))].push_back({places[k], records[k]});
  std::vector<T> slab(slabs.rows(link.rank()));
  for (const Placed& p : sent(link, to)) slab[p.place - slabs.first(link.rank())] = p.record;
  return slab;
}

/// The records at these places of a list of which each rank has a slab.
template <class T>
std::vector<T> at_places(RankLink& link, const std::vector<std::size_t>& places, const std::vector<T>& slab,
                         const Slabs& slabs) {
  std::vector<std::vector<std::size_t>> ask(std::size_t(link.ranks()));
  for (const std::size_t p : places) ask[std::size_t(slabs.owner(p))].push_back(p);
  std::vector<std::vector<T>> answers(ask.size());
  const auto asked = received(link, ask);
  for (std::size_t r = 0; r < asked.size(); ++r)
    for (const std::size_t p : asked[r]) answers[r].push_back(slab[p - slabs.first(link.rank())]);
  const auto got = received(link, answers);
  std::vector<std::size_t> next(got.size(), 0);
  std::vector<T> records;
  for (const std::size_t p : places) {
    const auto r = std::size_t(slabs.owner(p));
    records.push_back(got[r][next[r]++]);
  }
  return records;
}

}  // namespace breccia
