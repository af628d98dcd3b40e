// SPDX-License-Identifier: BSD-3-Clause
/// Fills an outline with discs one after the other, each of which touches two or three of what is there already.
#pragma once

#include <array>
#include <cstdint>
#include <queue>
#include <random>
#include <vector>

#include "breccia/packing_tools/container.hpp"
#include "breccia/services.hpp"
#include "curves.hpp"

namespace breccia::tangent_discs {

/// Two discs that touch by construction: places in AdvancingFront::discs().
struct Touch {
  Index i, j;
};

class AdvancingFront {
 public:
  /// Radii [m], max no larger than what fits into the container.
  AdvancingFront(const Container& container, double min, double max, std::uint64_t seed, Host& host);
  /// Until no disc of the smallest radius fits anywhere.
  void run();
  const std::vector<Disc>& discs() const { return discs_; }
  const std::vector<Touch>& touches() const { return touches_; }
  std::size_t touches_at_walls() const { return at_walls_; }

 private:
  using Id = std::uint32_t;  ///< of a curve: walls first, then discs
  /// The space beside two curves that are so near each other that the smallest disc cannot pass between them.
  struct Pocket {
    Id a, b;
    int side;
  };
  struct Candidate {
    Disc disc;
    Id third;
  };

  void begin();
  void empty_queues();
  bool fill(const Pocket& pocket);
  bool fill_with_three(const Pocket& pocket);
  bool fill_with_two(const Pocket& pocket);
  void find_near(const Pocket& pocket);
  bool is_free(const Disc& disc, std::span<const Id> touched, double slack);
  void add(const Disc& disc, std::span<const Id> touched);
  bool search_gaps();
  double random_radius();
  std::size_t cell_of(const Vec2& x) const;
  template <class F>
  void for_each_near(const Vec2& x, double reach, F&& f) const;
  void tell();

  Container container_;
  double min_, max_;
  std::mt19937_64 random_;
  Host& host_;
  std::vector<Curve> curves_;
  std::vector<Disc> discs_;
  std::vector<Touch> touches_;
  std::size_t walls_ = 0, at_walls_ = 0;
  double solid_ = 0;  ///< area of the discs over pi
  std::queue<Pocket> along_walls_, inside_;
  std::vector<Id> near_;  ///< curves that can be in the way in the pocket being filled
  std::vector<Candidate> candidates_;
  Vec2 low_;  ///< of the grid
  double cell_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Id> head_, next_;  ///< discs of each cell as a list
};

}  // namespace breccia::tangent_discs
