// SPDX-License-Identifier: BSD-3-Clause
/// A specimen made by hand in two parts, as two ranks of a job have them: for trials of what says that it sees parts.
#pragma once

#include <array>
#include <barrier>
#include <exception>
#include <string>
#include <thread>

#include "breccia/error.hpp"
#include "check/made_simulation.hpp"

namespace breccia {

/// Pairs and bonds in the order of the engine, by their lower particles.
MadeSimulation sorted(const MadeSimulation& simulation);

/// The lower and the upper half of the particles of a simulation that is `sorted`, each with copies of those that its
/// pairs and bonds meet.
std::array<MadeSimulation, 2> halves(const MadeSimulation& whole);

/// Two threads, each of which sees one of the halves.
class TwoParts {
 public:
  /// Calls `f(half, others)` of both at once. UserError when they do not ask each other for the same; else what the
  /// first throws, or the second.
  template <class F>
  void together(F&& f) {
    std::array<std::exception_ptr, 2> failed;
    over_ = false;
    const auto work = [&](int half) {
      Part& part = parts_[std::size_t(half)];
      try {
        f(half, part);
      } catch (...) { failed[std::size_t(half)] = std::current_exception(); }
      if (!part.over) part.meet({});
    };
    {
      const std::jthread second(work, 1);
      work(0);
    }
    for (const auto& one : failed)
      if (one) std::rethrow_exception(one);
    if (over_) throw UserError(unlike);
  }

 private:
  static constexpr const char* unlike =
      "what sees one part asks for other sums than what sees another (`view.sum`, `view.max`)";
  /// Nothing: it has come to its end.
  struct Asked {
    int act = 0;
    std::size_t size = 0;
    const void* of = nullptr;
  };
  class Part final : public OtherParts {
   public:
    Part(TwoParts& both, std::size_t number) : both_(both), number_(number) {}
    void add(std::span<ExactSum> sums) override;
    void largest(std::span<double> numbers) override;
    std::vector<std::byte> all(std::span<const std::byte> own, std::size_t record_bytes) override;
    /// Waits for the other; false when it asks for something else, or is through.
    bool meet(const Asked& asked);
    bool over = false;

   private:
    void must_meet(const Asked& asked) {
      if (over || !meet(asked)) throw UserError(unlike);
    }
    const Asked& other() const { return both_.asked_[1 - number_]; }
    TwoParts& both_;
    std::size_t number_;
  };

  std::barrier<> both_{2};
  std::array<Asked, 2> asked_;
  bool over_ = false;
  Part parts_[2] = {{*this, 0}, {*this, 1}};
};

}  // namespace breccia
