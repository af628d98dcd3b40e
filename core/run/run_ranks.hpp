// SPDX-License-Identifier: BSD-3-Clause
/// What a run agrees on with the same run on other ranks; alone, it answers itself.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "breccia/error.hpp"
#include "engine/rank_link.hpp"

namespace breccia {

class RunRanks {
 public:
  explicit RunRanks(RankLink* link) : link_(link) {}
  RankLink* link() const { return link_; }
  bool several() const { return link_ != nullptr; }
  bool first() const { return !link_ || link_->first(); }  ///< who has files and something to say
  bool as_first_says(bool here) const { return any_rank(link_, first() && here); }
  /// The first rank's text, or numbers, on all of them.
  std::string told(const std::string& text) const { return told_to_all(text); }
  std::vector<double> told(const std::vector<double>& numbers) const { return told_to_all(numbers); }
  std::int64_t sum(std::int64_t number) const {
    if (link_) link_->add({&number, 1});
    return number;
  }
  /// What `f(value)` makes of it on each rank in turn, each from what the one before has left.
  template <class T, class F>
  T one_after_the_other(T value, F&& f) const {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!link_) {
      f(value);
      return value;
    }
    std::vector<std::size_t> whose(std::size_t(link_->ranks()), 0);
    for (std::size_t r = 0; r < whose.size(); ++r) {
      if (r == std::size_t(link_->rank())) f(value);
      T left = value;
      whose[r] = 1;
      link_->gather(&value, whose, sizeof(T), &left, true);
      whose[r] = 0;
      value = left;
    }
    return value;
  }
  /// Of each number the largest of all ranks.
  void largest(std::span<double> numbers) const {
    if (link_) link_->largest(numbers);
  }
  /// Whether other ranks do not end as this one does; they cannot be asked to any more.
  bool alone() const { return link_ && !link_->all_end(); }

  /// A UserError of one of them fails on all. What else ends `f` on one alone ends the job: others may wait in it.
  template <class F>
  void together(F&& f) const {
    std::exception_ptr failed;
    try {
      f();
    } catch (const UserError&) { failed = std::current_exception(); }
    const bool any = any_rank(link_, failed != nullptr);
    if (failed) std::rethrow_exception(failed);
    if (any) throw UserError(other_failed);
  }
  /// What only the first rank may fail at ends the loop of all of them. `failure`: what has failed before.
  template <class F>
  void together(F&& f, std::string& failure) const {
    std::exception_ptr failed;
    try {
      f();
    } catch (...) { failed = std::current_exception(); }
    double thrown_said[2] = {failed ? 1.0 : 0.0, failure.empty() ? 0.0 : 1.0};
    largest(thrown_said);
    if (failed) std::rethrow_exception(failed);
    if (thrown_said[0] > 0) throw UserError(other_failed);
    if (thrown_said[1] > 0 && failure.empty()) failure = other_failed;
  }

 private:
  static constexpr const char* other_failed = "another rank could not go on";

  template <class List>
  List told_to_all(const List& mine) const {
    if (!link_) return mine;
    const std::vector<std::size_t> sizes = link_->numbers_of_all(first() ? mine.size() : 0);
    List all;
    all.resize(sizes.front());
    if (!all.empty()) link_->gather(mine.data(), sizes, sizeof(mine[0]), all.data(), true);
    return all;
  }

  RankLink* link_;
};

}  // namespace breccia
