// SPDX-License-Identifier: BSD-3-Clause
/// A specimen in parts, one for each rank of a job.
///
/// Particles keep the rows of the whole (Morton order); each rank owns a range of whole blocks of them, with about as
/// many pairs and particles as the others, and never has more than these and copies of those that they meet. It
/// evaluates every pair that touches an own particle: a pair that joins two parts on both sides, from the same inputs,
/// hence with the same history. So nothing but the motion of copies travels, each particle's sum keeps its one order,
/// and no bit depends on where the cuts are. What is counted of pairs and bonds is counted by the part of their lower
/// particle.
#pragma once

#include "engine/migration.hpp"
#include "engine/rank_link.hpp"
#include "model/state.hpp"

namespace breccia {

/// When a bond broke first: the step, then its place among those of that step.
struct CrackKey {
  std::uint64_t step, place;
};

/// Of a list of pairs or bonds here: the first that is counted here, as all behind it are.
std::size_t first_counted(const std::vector<Index>& i, const Particles& particles);
/// Numbers of particles here, from that one on, as rows of the whole.
std::vector<Index> as_rows(const std::vector<Index>& of, std::size_t from, const Particles& particles);

/// Rows at which the ranks' ranges of whole blocks begin, and the number of all: about the same weight for each.
/// UserError when there are more ranks than blocks.
std::vector<Index> shares_of_ranks(std::span<const double> weights_of_blocks, std::size_t rows, int ranks);
std::vector<Index> even_shares(std::size_t rows, int ranks);  ///< as many particles for each

class Parts {
 public:
  explicit Parts(RankLink& link) : link_(&link) {}

  RankLink& link() const { return *link_; }
  Index first_row(int rank) const { return first_row_[std::size_t(rank)]; }
  Index first_row() const { return first_row(link_->rank()); }
  Index end_row() const { return first_row(link_->rank() + 1); }
  std::size_t rows() const { return first_row_.back(); }
  int owner(Index row) const {
    return int(std::upper_bound(first_row_.begin(), first_row_.end(), row) - first_row_.begin()) - 1;
  }
  int changes() const { return changes_; }  ///< how often particles have got another owner

  /// Of particles alone: either all, the same on all ranks, of which the own ones stay, or what `assemble` made of this
  /// rank's share.
  void begin(State& state);
  /// The specimen as it is, on the first rank or everywhere; elsewhere the lists of particles, pairs, bonds and touches
  /// are empty. Those of the given state are left as they are.
  State whole(State& part, bool everywhere) const;
  /// Of bonds that are counted here and have broken: which they are, and where their cracks stand among those of the
  /// whole, in the order in which they came. All ranks ask together.
  struct CrackPlaces {
    std::vector<std::size_t> bond, place;
    std::size_t total = 0;
  };
  CrackPlaces crack_places(const Bonds& bonds, const Particles& particles) const;

  /// Work is dealt anew: particles, with all that is known of them, go to whom they belong to now; copies of others
  /// have their place, and `renew_copies` fills it. `contacts`: other pairs that are known by their particles. What
  /// else stands by own particle goes with the result.
  Migration deal_again(State& part, Bonds& contacts);
  /// Copies anew: of all particles that may come within `skin` of own ones, and that own pairs and bonds meet.
  void renew_copies(State& part, Bonds& contacts, double skin);
  /// Places for these rows of the whole, the own ones among them and all that is met: what is known of those that were
  /// here already stays for own ones alone.
  void place(State& part, Bonds& contacts, const std::vector<Index>& rows);
  /// Where a row of the whole stands here, or `elsewhere`.
  static Index here(const Particles& particles, Index row);
  static constexpr Index elsewhere = 0xffffffffu;

  /// A bond broke in this step: where it stands among those of other ranks.
  void note_crack(const State& part, Index bond);
  /// Of those that are known to the whole specimen, and stand in its order; `keep`: their places in it.
  void know_cracks(const std::vector<Index>& kept) {
    crack_keys_.clear();
    for (const Index place : kept) crack_keys_.push_back({0, place});
  }
  /// By how much the busiest rank has more to do than the mean.
  double imbalance(const State& part) const;

  /// Own records of all ranks, one after the other.
  template <class T>
  std::vector<T> gathered(std::span<const T> own, bool everywhere) const {
    const std::vector<std::size_t> counts = link_->numbers_of_all(own.size());
    std::size_t total = 0;
    for (const std::size_t c : counts) total += c;
    std::vector<T> all(everywhere || link_->first() ? total : 0);
    if (total) link_->gather(own.data(), counts, sizeof(T), all.data(), everywhere);
    return all;
  }
  template <class T>
  std::vector<T> gathered(const std::vector<T>& own, bool everywhere) const {
    return gathered(std::span<const T>(own), everywhere);
  }
  /// Of an array with a record a row.
  template <class T>
  std::vector<T> gathered_rows(const std::vector<T>& rows, const Particles& p, bool everywhere) const {
    if (rows.empty()) return {};
    return gathered(std::span<const T>(rows).subspan(p.first_own(), p.end_own() - p.first_own()), everywhere);
  }
  /// How many of those the ranks before have.
  std::size_t before(std::size_t own) const;

 private:
  std::vector<Crack> cracks(const Bonds& bonds, const Particles& particles, std::vector<Index>& crack_of,
                            bool everywhere) const;
  void stand(Particles& p, const std::vector<Index>& rows);
  void give_places(State& part, const std::vector<Index>& rows);
  std::vector<Index> rows_of_others(const State& part, const std::vector<std::vector<Index>>& asked, double skin) const;

  RankLink* link_;
  std::vector<Index> first_row_;  ///< of each rank, and the number of all
  int changes_ = 0;
  std::vector<CrackKey> crack_keys_;
};

/// Which pair each bond has, and back. Both lists are in the order (i, j).
void link_bonds(Pairs& pairs, Bonds& bonds);

/// Around a block of particles.
struct BlockBox {
  Vec3 low, high;  ///< of the centres [m]
  double radius;   ///< largest [m]
};
std::vector<BlockBox> boxes_of_blocks(const Particles& particles);
/// Sets `near[a - first own]` for those that may have a particle of `others` within `skin`.
void mark_near(const State& part, std::span<const BlockBox> own, std::span<const BlockBox> others, double skin,
               std::vector<std::uint8_t>& near);

}  // namespace breccia
