// SPDX-License-Identifier: BSD-3-Clause
/// Lists of a specimen in parts on their way to a file and back: of each every rank has some rows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "breccia/archive.hpp"

namespace breccia {

/// What one rank has of a list of the whole.
struct ListShare {
  std::size_t first = 0, rows = 0, total = 0;
};

/// Ranges of places of a list of the whole, as many for each rank.
class Slabs {
 public:
  Slabs(std::size_t total, int ranks) : total_(total), ranks_(std::size_t(ranks)) {}
  std::size_t total() const { return total_; }
  std::size_t first(int rank) const { return first_of(std::size_t(rank)); }
  std::size_t rows(int rank) const { return first_of(std::size_t(rank) + 1) - first(rank); }
  ListShare of(int rank) const { return {first(rank), rows(rank), total_}; }
  /// Whose range it is in.
  int owner(std::size_t place) const {
    std::size_t r = std::min(ranks_ - 1, std::size_t(double(place) / double(total_) * double(ranks_)));
    while (first_of(r) > place) --r;
    while (first_of(r + 1) <= place) ++r;
    return int(r);
  }

 private:
  std::size_t first_of(std::size_t rank) const { return total_ / ranks_ * rank + total_ % ranks_ * rank / ranks_; }

  std::size_t total_, ranks_;
};

/// Beside an `Archive` that can take lists from all ranks, or give each its rows: what goes through the archive while a
/// `Rows` stands is a rank's share of a list, and all ranks call it together; all else is the same on all of them.
class BRECCIA_API SharedLists {
 public:
  virtual ~SharedLists() = default;
  /// False of one that only wants to know how much there is.
  virtual bool wants_values() const { return true; }
  std::size_t total() const { return total_; }  ///< rows of the list that was read last

  class Rows {
   public:
    /// These; when it is read, UserError on all ranks where the list has another length.
    Rows(SharedLists& of, const ListShare& share) : of_(of) { of_.share_ = share; }
    /// To be read: of whatever there is an even share.
    Rows(SharedLists& of, int rank, int ranks) : of_(of) {
      of_.rank_ = rank;
      of_.ranks_ = ranks;
    }
    ~Rows() {
      of_.share_.reset();
      of_.ranks_ = 0;
    }
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;

   private:
    SharedLists& of_;
  };

 protected:
  /// What is to be written, if it is a share.
  const std::optional<ListShare>& share() const { return share_; }
  /// What is to be read of a list; all of it where no `Rows` stands. None where it has another length.
  std::optional<ListShare> share_of(std::size_t total) {
    total_ = total;
    if (ranks_ > 0) return Slabs(total, ranks_).of(rank_);
    if (!share_) return ListShare{0, total, total};
    return share_->total == total ? share_ : std::nullopt;
  }

 private:
  std::optional<ListShare> share_;
  int rank_ = 0, ranks_ = 0;
  std::size_t total_ = 0;
};

/// A file of HDF5 that all ranks write together. What fails does so on all of them: UserError. After that no such file
/// can be written any more: HDF5 cannot give up what it has begun.
class SharedFile {
 public:
  virtual ~SharedFile() = default;
  virtual void group(const std::string& path) = 0;
  /// A list of `share.total` rows, of which each rank gives its own, packed.
  virtual void list(const std::string& path, archived::Element element, std::size_t columns, const ListShare& share,
                    const void* rows) = 0;
  /// All its bytes are on the disk.
  virtual void close() = 0;
};

}  // namespace breccia
