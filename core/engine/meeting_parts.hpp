// SPDX-License-Identifier: BSD-3-Clause
/// How plugins that see parts of a specimen meet: what they ask of each other, and how what fails in one of them ends
/// the call of all.
#pragma once

#include <exception>
#include <numeric>
#include <string>

#include "breccia/error.hpp"
#include "breccia/views.hpp"
#include "engine/rank_link.hpp"

namespace breccia {

/// Asks without a word before: for those who are called on all ranks, on the same numbers.
class LinkedParts : public OtherParts {
 public:
  explicit LinkedParts(RankLink* link) : link_(link) {}  ///< null where there is one rank
  bool first() const { return !link_ || link_->first(); }
  RankLink* link() const { return link_; }

  void add(std::span<ExactSum> sums) override {
    for (ExactSum& s : sums) s.carry();
    link_->add({reinterpret_cast<std::int64_t*>(sums.data()), sums.size() * ExactSum::words});
  }
  void largest(std::span<double> numbers) override { link_->largest(numbers); }
  std::vector<std::byte> all(std::span<const std::byte> own, std::size_t record_bytes) override {
    const std::vector<std::size_t> counts = link_->numbers_of_all(own.size() / record_bytes);
    std::vector<std::byte> of_all(std::accumulate(counts.begin(), counts.end(), std::size_t(0)) * record_bytes);
    if (!of_all.empty()) link_->gather(own.data(), counts, record_bytes, of_all.data(), true);
    return of_all;
  }

 protected:
  RankLink* link_;
};

/// Before each message all say what they are about to do, so that none waits for one that has failed or asks for
/// something else.
class MeetingParts final : public LinkedParts {
 public:
  using LinkedParts::LinkedParts;

  /// Calls `f()` on all ranks together. What it throws on one is thrown there; on the others a UserError of that text.
  template <class F>
  void together(F&& f) {
    if (!link_) return f();
    over_.clear();
    std::exception_ptr failed;
    std::string text;
    try {
      f();
    } catch (const std::exception& e) {
      failed = std::current_exception();
      text = e.what();
    } catch (...) {
      failed = std::current_exception();
      text = "something that is not an exception was thrown";
    }
    if (over_.empty()) meet(end, 0, failed != nullptr, text);
    if (failed) std::rethrow_exception(failed);
    if (!over_.empty()) throw UserError(over_);
  }

  void add(std::span<ExactSum> sums) override {
    agree(sum, sums.size());
    LinkedParts::add(sums);
  }
  void largest(std::span<double> numbers) override {
    agree(maximum, numbers.size());
    LinkedParts::largest(numbers);
  }
  std::vector<std::byte> all(std::span<const std::byte> own, std::size_t record_bytes) override {
    agree(records, record_bytes);
    return LinkedParts::all(own, record_bytes);
  }

 private:
  enum Act { end, sum, maximum, records };

  void agree(Act act, std::size_t size) {
    meet(act, size, false, {});
    if (!over_.empty()) throw UserError(over_);
  }

  /// Sets `over_` where this call cannot go on.
  void meet(Act act, std::size_t size, bool failed, const std::string& text) {
    if (!over_.empty()) return;  // whoever asks again is not answered any more
    double said[] = {failed ? 1.0 : 0.0, double(act), -double(act), double(size), -double(size)};
    link_->largest(said);
    if (said[0] > 0) {
      const std::vector<std::size_t> sizes = link_->numbers_of_all(failed ? text.size() : 0);
      std::size_t total = 0, of_first = 0;  // of those that failed
      for (const std::size_t s : sizes) {
        total += s;
        if (of_first == 0) of_first = s;
      }
      over_.resize(total);
      if (total) link_->gather(text.data(), sizes, 1, over_.data(), true);
      over_.resize(of_first);
      if (over_.empty()) over_ = "another rank could not go on";
    } else if (said[1] != -said[2] || said[3] != -said[4]) {
      over_ =
          "what sees the parts of a specimen (`sees_parts`) must ask for the same sums and maxima on all ranks, and "
          "one of them asked for others";
    }
  }

  std::string over_;  ///< why this call cannot go on
};

}  // namespace breccia
