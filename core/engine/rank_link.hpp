// SPDX-License-Identifier: BSD-3-Clause
/// The ranks of a job as the engine knows them: what it asks of the others. All of them call the same functions in the
/// same order; each waits for the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "breccia/types.hpp"
#include "engine/shared_lists.hpp"

namespace breccia {

class RankLink {
 public:
  virtual ~RankLink() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  virtual int ranks_on_machine() const = 0;  ///< on this one
  bool first() const { return rank() == 0; }

  /// Each number becomes the largest of all ranks' numbers at its place. No NaN.
  virtual void largest(std::span<double> numbers) = 0;
  /// Each becomes the sum of all ranks' numbers at its place.
  virtual void add(std::span<std::int64_t> numbers) = 0;
  virtual std::vector<std::size_t> numbers_of_all(std::size_t own) = 0;
  /// The records of all ranks, in the ranks' order: on the first, or `everywhere`. `counts`: of each rank.
  virtual void gather(const void* own, std::span<const std::size_t> counts, std::size_t record_bytes, void* all,
                      bool everywhere) = 0;
  /// `to[r]`, whole records, goes to rank r; what they have sent comes back.
  virtual std::vector<std::vector<std::byte>> exchange(const std::vector<std::vector<std::byte>>& to,
                                                       std::size_t record_bytes) = 0;

  /// Rows of other ranks that stand among the own ones as copies.
  struct Copies {
    std::size_t first_own = 0, own = 0;
    std::vector<Index> at;        ///< row here
    std::vector<int> owner;       ///< rank
    std::vector<Index> in_owner;  ///< which of the owner's own rows
  };
  virtual void follow(const Copies& copies) = 0;
  /// Of an array with a record a row: copies become what their owners have. `begin_` and `end_forward`: other rows may
  /// be worked on between the two.
  virtual void begin_forward(void* records, std::size_t record_bytes) = 0;
  virtual void end_forward(void* records, std::size_t record_bytes) = 0;

  /// A new file that all write together, with so many bytes left free at its beginning.
  virtual std::unique_ptr<SharedFile> shared_file(const std::string& path, std::size_t bytes_ahead) = 0;

  /// From which imbalance on particles change their ranks; that of the busiest over the mean, less 1.
  virtual double tolerated_imbalance() const { return 0.2; }
  /// Before a rank ends with an error: true when all have come here, as they do when they have made the same mistake;
  /// false when the others do not come within some seconds.
  virtual bool all_end() = 0;
  virtual void abort(int code) = 0;  ///< of all ranks; does not return

  template <class T>
  void forward(std::vector<T>& records) {
    if (records.empty()) return;
    begin_forward(records.data(), sizeof(T));
    end_forward(records.data(), sizeof(T));
  }
  double largest_of(double number) {
    largest({&number, 1});
    return number;
  }
  double least_of(double number) { return -largest_of(-number); }
  bool any(bool here) { return largest_of(here ? 1 : 0) > 0; }
  bool as_first_says(bool here) { return any(first() && here); }
};

// Where there is but one rank (null) its own answer is that of all.
inline bool any_rank(RankLink* link, bool here) { return link ? link->any(here) : here; }
inline double largest_of_ranks(RankLink* link, double number) { return link ? link->largest_of(number) : number; }

}  // namespace breccia
