// SPDX-License-Identifier: BSD-3-Clause
/// Sums over many particles or pairs that cost no more than plain ones and have the same bits for any number of ranks.
#pragma once

#include "breccia/views.hpp"

namespace breccia {

/// Terms of own particles, or of own pairs or bonds by their lower particle, in the order of their rows: added plainly
/// within each block of particles, the sums of the blocks exactly. `ExactSumOf` alone costs some nanoseconds a number.
///
///     BlockSum<Mat3> moments(view);
///     for (const std::size_t k : view.own_pairs()) moments.add(view.pairs.i[k], ...);
///     view.sum(moments.exact());
template <class T>
class BlockSum {
 public:
  explicit BlockSum(const SimulationView& view) : size_(view.block), end_(view.own_particles().first() + size_) {}

  void add(std::size_t particle, const T& term) {
    while (particle >= end_) {
      finish_block();
      end_ += size_;
    }
    sum_ += term;
  }
  /// Of all terms so far; others, in whatever order, may be added to it.
  ExactSumOf<T>& exact() {
    finish_block();
    return exact_;
  }

 private:
  static T zero() {
    if constexpr (std::is_arithmetic_v<T>) return T(0);
    else return T::Zero();
  }
  void finish_block() {
    exact_.add(sum_);
    sum_ = zero();
  }

  std::size_t size_, end_;
  T sum_ = zero();
  ExactSumOf<T> exact_;
};

}  // namespace breccia
