// SPDX-License-Identifier: BSD-3-Clause
/// Ranks that are threads of this process: what the engine asks of other ranks, without a launcher and without MPI.
#pragma once

#include <barrier>
#include <cstring>
#include <exception>
#include <functional>
#include <thread>

#include "archive/memory_archive.hpp"
#include "breccia/error.hpp"
#include "engine/rank_link.hpp"

namespace breccia::testing {

/// What they have in common.
struct ThreadRanks {
  explicit ThreadRanks(int count) : ranks(count), all(count), given(std::size_t(count)), sizes(std::size_t(count)) {}
  int ranks;
  std::barrier<> all;
  std::vector<const void*> given;  ///< by each, until all have read it
  std::vector<std::size_t> sizes;
};

class ThreadLink final : public RankLink {
 public:
  ThreadLink(ThreadRanks& job, int rank, double tolerated) : job_(job), rank_(rank), tolerated_(tolerated) {}
  int rank() const override { return rank_; }
  int ranks() const override { return job_.ranks; }
  int ranks_on_machine() const override { return job_.ranks; }
  double tolerated_imbalance() const override { return tolerated_; }

  void largest(std::span<double> numbers) override {
    const std::vector<double> own(numbers.begin(), numbers.end());
    share(own.data(), [&](const void* other) {
      for (std::size_t k = 0; k < numbers.size(); ++k)
        numbers[k] = std::max(numbers[k], static_cast<const double*>(other)[k]);
    });
  }
  void add(std::span<std::int64_t> numbers) override {
    const std::vector<std::int64_t> own(numbers.begin(), numbers.end());
    std::fill(numbers.begin(), numbers.end(), 0);
    share(own.data(), [&](const void* other) {
      for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] += static_cast<const std::int64_t*>(other)[k];
    });
  }
  std::vector<std::size_t> numbers_of_all(std::size_t own) override {
    std::vector<std::size_t> numbers;
    share(&own, [&](const void* other) { numbers.push_back(*static_cast<const std::size_t*>(other)); });
    return numbers;
  }
  void gather(const void* own, std::span<const std::size_t> counts, std::size_t bytes, void* all,
              bool everywhere) override {
    std::size_t rank = 0;
    auto* to = static_cast<std::byte*>(all);
    share(own, [&](const void* other) {
      const std::size_t size = counts[rank++] * bytes;
      if ((everywhere || first()) && size) std::memcpy(to, other, size);
      if (everywhere || first()) to += size;
    });
  }
  std::vector<std::vector<std::byte>> exchange(const std::vector<std::vector<std::byte>>& to, std::size_t) override {
    std::vector<std::vector<std::byte>> from;
    share(&to, [&](const void* other) {
      from.push_back((*static_cast<const std::vector<std::vector<std::byte>>*>(other))[std::size_t(rank_)]);
    });
    return from;
  }
  void follow(const Copies& copies) override { copies_ = copies; }
  void begin_forward(void* records, std::size_t bytes) override {
    std::vector<const std::byte*> of;
    const auto* own = static_cast<const std::byte*>(records) + copies_.first_own * bytes;
    job_.given[std::size_t(rank_)] = own;
    job_.all.arrive_and_wait();
    for (std::size_t k = 0; k < copies_.at.size(); ++k)
      std::memcpy(
          static_cast<std::byte*>(records) + copies_.at[k] * bytes,
          static_cast<const std::byte*>(job_.given[std::size_t(copies_.owner[k])]) + copies_.in_owner[k] * bytes,
          bytes);
    job_.all.arrive_and_wait();
  }
  void end_forward(void*, std::size_t) override {}
  std::unique_ptr<SharedFile> shared_file(const std::string&, std::size_t) override { return {}; }
  bool all_end() override { return true; }
  void abort(int) override { std::terminate(); }

 private:
  /// Calls `take` with what each has given, in the order of ranks.
  template <class Take>
  void share(const void* own, Take&& take) {
    job_.given[std::size_t(rank_)] = own;
    job_.all.arrive_and_wait();
    for (const void* other : job_.given) take(other);
    job_.all.arrive_and_wait();
  }

  ThreadRanks& job_;
  int rank_;
  double tolerated_;
  Copies copies_;
};

/// What the ranks write together, on the first; each has one.
class SharedMemoryArchive final : public MemoryArchive {
 public:
  explicit SharedMemoryArchive(RankLink* link) : link_(link) {}

 private:
  void write(const std::string& path, archived::Element element, const void* data, std::size_t rows,
             std::size_t columns, std::size_t stride) override {
    if (!link_ || !share()) return MemoryArchive::write(path, element, data, rows, columns, stride);
    const ListShare own = *share();
    const auto counts = link_->numbers_of_all(rows);
    std::size_t before = 0, all = 0;
    for (int r = 0; r < link_->ranks(); ++r) {
      if (r < link_->rank()) before += counts[std::size_t(r)];
      all += counts[std::size_t(r)];
    }
    if (own.rows != rows || own.total != all || (rows > 0 && own.first != before))
      refuse(path, "the shares are not the whole");
    const std::size_t row = columns * size_of(element);
    std::vector<std::byte> packed(rows * row), whole(link_->first() ? all * row : 0);
    for (std::size_t k = 0; k < rows && row > 0; ++k)
      std::memcpy(packed.data() + k * row, static_cast<const char*>(data) + k * stride, row);
    link_->gather(packed.data(), counts, row, whole.data(), false);
    if (link_->first()) MemoryArchive::write(path, element, whole.data(), all, columns, row);
  }

  RankLink* link_;
};

/// Calls `work(link)` on each of the ranks; with one, with null.
inline void on_ranks(int ranks, const std::function<void(RankLink*)>& work, double tolerated = 0.2) {
  if (ranks == 1) return work(nullptr);
  ThreadRanks job(ranks);
  std::vector<std::jthread> threads;
  for (int r = 0; r < ranks; ++r)
    threads.emplace_back([&, r] {
      ThreadLink link(job, r, tolerated);
      work(&link);
    });
}

}  // namespace breccia::testing
