// SPDX-License-Identifier: BSD-3-Clause
/// Uniform cell grid over points: finds all pairs that can be closer than a cutoff, in an order that depends on the
/// points alone. Used by the engine's neighbour search and by packings.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "breccia/error.hpp"
#include "breccia/strided.hpp"
#include "breccia/types.hpp"

namespace breccia {

class CellGrid {
 public:
  /// `cutoff` [m]: pairs farther apart than this need not be found. Points must be finite.
  CellGrid(Strided<const Vec3> points, double cutoff) : points_(points) {
    BRECCIA_ASSERT(cutoff > 0);
    if (points.empty()) return;
    low_ = points[0];
    Vec3 high = points[0];
    for (const Vec3& p : points) {
      low_ = low_.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    // A far stray must not blow up the grid: at most about four cells per point.
    const Vec3 extent = high - low_;
    cell_ = cutoff;
    for (;; cell_ *= 1.26) {
      const Vec3 cells = extent / cell_ + Vec3::Ones();
      if (cells.prod() <= 64.0 + 4.0 * double(points.size())) break;
    }
    for (int k = 0; k < 3; ++k) count_[k] = std::size_t(extent[k] / cell_) + 1;
    const std::size_t cells = count_[0] * count_[1] * count_[2];
    start_.assign(cells + 1, 0);
    std::vector<std::size_t> of(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) ++start_[(of[p] = cell_of(points[p])) + 1];
    for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
    members_.resize(points.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t p = 0; p < points.size(); ++p) members_[next[of[p]]++] = Index(p);
  }

  /// The points, cell by cell.
  std::span<const Index> members() const { return members_; }

  /// Calls f(q) for every point q that can be within the cutoff of x (x itself included if it is a point).
  template <class F>
  void for_each_near(const Vec3& x, F&& f) const {
    for_each_run_near(x, [&](std::size_t begin, std::size_t end) {
      for (std::size_t m = begin; m < end; ++m) f(members_[m]);
    });
  }

  /// The same, as ranges [begin, end) of `members()`.
  template <class F>
  void for_each_run_near(const Vec3& x, F&& f) const {
    if (members_.empty()) return;
    std::size_t low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      const double at = std::floor((x[k] - low_[k]) / cell_);
      const double last = double(count_[k]) - 1;
      if (at < -1 || at > last + 1) return;
      low[k] = std::size_t(std::max(0.0, at - 1));
      high[k] = std::size_t(std::min(last, at + 1));
    }
    for (std::size_t c = low[2]; c <= high[2]; ++c)
      for (std::size_t b = low[1]; b <= high[1]; ++b) {
        const std::size_t row = (c * count_[1] + b) * count_[0];
        f(start_[row + low[0]], start_[row + high[0] + 1]);
      }
  }

  /// Calls f(i, j) once for every pair i < j that can be within the cutoff; all partners of i before those of i + 1.
  template <class F>
  void for_each_pair(F&& f) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      for_each_near(points_[i], [&](Index j) {
        if (j > i) f(Index(i), j);
      });
  }

 private:
  std::size_t cell_of(const Vec3& x) const {
    std::size_t c[3];
    for (int k = 0; k < 3; ++k) c[k] = std::min(std::size_t((x[k] - low_[k]) / cell_), count_[k] - 1);
    return (c[2] * count_[1] + c[1]) * count_[0] + c[0];
  }

  Strided<const Vec3> points_;
  Vec3 low_ = Vec3::Zero();
  double cell_ = 1;
  std::size_t count_[3] = {0, 0, 0};
  std::vector<std::size_t> start_;
  std::vector<Index> members_;
};

}  // namespace breccia
