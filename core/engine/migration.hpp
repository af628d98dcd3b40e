// SPDX-License-Identifier: BSD-3-Clause
/// Rows that change their ranks, and the lists that go with them: from each rank to those that own them now.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "engine/rank_link.hpp"

namespace breccia {

/// `to[r]` goes to rank r; what each of them has sent.
template <class T>
std::vector<std::vector<T>> received(RankLink& link, const std::vector<std::vector<T>>& to) {
  std::vector<std::vector<std::byte>> bytes(to.size());
  for (std::size_t r = 0; r < to.size(); ++r) {
    const auto* const begin = reinterpret_cast<const std::byte*>(to[r].data());
    bytes[r].assign(begin, begin + to[r].size() * sizeof(T));
  }
  const auto from = link.exchange(bytes, sizeof(T));
  std::vector<std::vector<T>> got(from.size());
  for (std::size_t r = 0; r < from.size(); ++r) {
    got[r].resize(from[r].size() / sizeof(T));
    std::copy(from[r].begin(), from[r].end(), reinterpret_cast<std::byte*>(got[r].data()));
  }
  return got;
}

/// The same, one after the other.
template <class T>
std::vector<T> sent(RankLink& link, const std::vector<std::vector<T>>& to) {
  std::vector<T> all;
  for (const std::vector<T>& part : received(link, to)) all.insert(all.end(), part.begin(), part.end());
  return all;
}

class Migration {
 public:
  /// Rows of the whole at which the ranges of the ranks begin, and the number of all: as it was, and as it is to be.
  Migration(RankLink& link, std::vector<Index> from, std::vector<Index> to)
      : link_(&link), from_(std::move(from)), to_(std::move(to)) {}

  RankLink& link() const { return *link_; }
  std::size_t ranks() const { return to_.size() - 1; }
  int owner(Index row) const { return int(std::upper_bound(to_.begin(), to_.end(), row) - to_.begin()) - 1; }
  Index first_before() const { return from_[std::size_t(link_->rank())]; }
  Index end_before() const { return from_[std::size_t(link_->rank()) + 1]; }
  Index first() const { return to_[std::size_t(link_->rank())]; }
  Index end() const { return to_[std::size_t(link_->rank()) + 1]; }

  /// A record for each row that was owned, in their order, to one for each that is owned.
  template <class T>
  std::vector<T> rows(std::span<const T> own) const {
    std::vector<std::vector<T>> to(ranks());
    for (std::size_t r = 0; r < to.size(); ++r) {
      const Index begin = std::max(to_[r], first_before()), end = std::min(to_[r + 1], end_before());
      if (begin < end) to[r].assign(own.begin() + (begin - first_before()), own.begin() + (end - first_before()));
    }
    return sent(*link_, to);
  }
  /// Records to the owner of the row that each is of.
  template <class T, class RowOf>
  std::vector<T> by_row(const std::vector<T>& records, RowOf&& row_of) const {
    std::vector<std::vector<T>> to(ranks());
    for (const T& r : records) to[std::size_t(owner(row_of(r)))].push_back(r);
    return sent(*link_, to);
  }

 private:
  RankLink* link_;
  std::vector<Index> from_, to_;
};

/// A list of pairs of particles that stand with each owner of either, and now go to the new ones: those that were told
/// of twice stay once, in the order (i, j) of the whole.
class PairMigration {
 public:
  /// `i`, `j`: rows of the whole, of which one at the least was owned.
  PairMigration(const Migration& move, const std::vector<Index>& i, const std::vector<Index>& j);

  std::vector<Index> i, j;  ///< now, as rows of the whole

  /// A record a pair, likewise; of an array that not all ranks have, zero where it was not there.
  template <class T>
  void operator()(std::vector<T>& records) const {
    RankLink& link = move_.link();
    if (!link.any(!records.empty())) return;
    records.resize(size_before_);
    std::vector<std::vector<T>> to(take_.size());
    for (std::size_t r = 0; r < to.size(); ++r) {
      to[r].reserve(take_[r].size());
      for (const Index k : take_[r]) to[r].push_back(records[k]);
    }
    const std::vector<T> got = sent(link, to);
    records.clear();
    records.reserve(kept_.size());
    for (const Index k : kept_) records.push_back(got[k]);
  }

 private:
  const Migration& move_;
  std::size_t size_before_;
  std::vector<std::vector<Index>> take_;  ///< for each rank, of the pairs before
  std::vector<Index> kept_;               ///< of what has come
};

}  // namespace breccia
