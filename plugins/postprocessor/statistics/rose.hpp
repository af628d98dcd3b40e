// SPDX-License-Identifier: BSD-3-Clause
/// Rose of the directions of lines: a histogram over the full angle.
#pragma once

#include <cstddef>
#include <vector>

#include "breccia/views.hpp"

namespace breccia {

/// Directions projected on one plane (u, v); the angle goes from u to v [rad].
class Rose {
 public:
  /// `sectors`, an even number, share the full angle from 0 on. `largest_tilt`: largest angle between a direction and
  /// the plane at which it counts [rad]; pi/2 for all.
  Rose(std::size_t sectors, double largest_tilt);

  /// A line with components u, v in the plane and w out of it, of any length, without sense: it counts in the sector of
  /// (u, v) and in that of (-u, -v). Not counted when tilted further than asked, nor when normal to the plane to within
  /// 1e-9: its projection is rounding, not a direction.
  void add(double u, double v, double w);

  /// Lines of all parts, which ask together.
  void meet(const SeenInPart& parts);

  double angle(std::size_t k) const;  ///< where sector k begins [rad]; 0 <= k <= number of sectors
  const std::vector<std::size_t>& counts() const { return counts_; }
  std::size_t lines() const { return lines_; }  ///< that counted; the counts add up to twice as many

 private:
  double largest_tilt_;
  std::size_t lines_ = 0;
  std::vector<std::size_t> counts_;
};

}  // namespace breccia
