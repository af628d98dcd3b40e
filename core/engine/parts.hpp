// SPDX-License-Identifier: BSD-3-Clause
/// A specimen in parts, one for each rank of a job.
///
/// Particles keep the rows that assembly gave them (Morton order); each rank owns a range of whole blocks of them, with
/// about as many pairs and particles as the others. It evaluates every pair that touches an own particle: a pair that
/// joins two parts on both sides, from the same inputs, hence with the same history. So nothing but the motion of
/// copies travels, each particle's sum keeps its one order, and no bit depends on where the cuts are. What is counted
/// of pairs and bonds is counted by the part of their lower particle.
#pragma once

#include "engine/rank_link.hpp"
#include "model/state.hpp"

namespace breccia {

class Parts {
 public:
  explicit Parts(RankLink& link) : link_(&link) {}

  RankLink& link() const { return *link_; }
  bool parted() const { return parted_; }
  Index first_row(int rank) const { return first_row_[std::size_t(rank)]; }
  Index first_row() const { return first_row(link_->rank()); }
  Index end_row() const { return first_row(link_->rank() + 1); }
  std::size_t rows() const { return first_row_.back(); }
  int changes() const { return changes_; }  ///< how often particles have got another owner

  /// Of a whole specimen, the same on all ranks, what belongs to this one stays. `contacts`: other pairs that are known
  /// by their particles. UserError when there are more ranks than blocks of particles.
  void cut(State& whole, Bonds& contacts);
  /// The specimen as it is, on the first rank or everywhere; elsewhere the lists of particles, pairs, bonds and touches
  /// are empty. Those of the given state are left as they are.
  State whole(State& part, bool everywhere) const;
  Bonds whole(const Bonds& bonds, const Particles& particles, bool everywhere) const;
  /// From now on `part` is a whole specimen.
  void join() { parted_ = false; }

  /// Copies anew: of all particles that may come within `skin` of own ones, and that own pairs and bonds meet.
  void renew_copies(State& part, Bonds& contacts, double skin);

  /// A bond broke in this step: where it stands among those of other ranks.
  void note_crack(const State& part, Index bond);
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
  /// Of an array with a record a row.
  template <class T>
  std::vector<T> gathered_rows(const std::vector<T>& rows, const Particles& p, bool everywhere) const {
    if (rows.empty()) return {};
    return gathered(std::span<const T>(rows).subspan(p.first_own(), p.end_own() - p.first_own()), everywhere);
  }

 private:
  /// When a bond broke first: the step, then its place among those of that step.
  struct CrackKey {
    std::uint64_t step, place;
  };
  void deal(const State& whole);
  void stand(Particles& p, const std::vector<Index>& rows);
  std::vector<std::vector<Index>> rows_for_others(const State& part, std::vector<std::vector<Index>> asked,
                                                  double skin) const;

  RankLink* link_;
  std::vector<Index> first_row_;  ///< of each rank, and the number of all
  bool parted_ = false;
  int changes_ = 0;
  std::vector<CrackKey> crack_keys_;
};

/// Of bonds, or pairs, by their lower particles: the first that is counted in this part; all from there on are.
std::size_t first_counted(const std::vector<Index>& i, const Particles& p);

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
