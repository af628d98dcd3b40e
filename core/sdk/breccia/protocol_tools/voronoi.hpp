// SPDX-License-Identifier: BSD-3-Clause
/// Voronoi cells of points on a rectangle, flat or rolled up to a cylinder: how much of a surface each particle stands for.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "breccia/types.hpp"

namespace breccia {

/// x across the width, from 0 (or anywhere when the width wraps), y along the height [m].
using SurfacePoint = Eigen::Vector2d;

namespace detail {

/// A convex polygon about the origin that half planes cut down.
class VoronoiCell {
 public:
  VoronoiCell(double left, double right, double low, double high)
      : corners_{{left, low}, {right, low}, {right, high}, {left, high}} {}

  /// Keeps what is nearer to the origin than to `other`.
  void cut(const SurfacePoint& other) {
    const double half = 0.5 * other.squaredNorm();
    kept_.clear();
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const SurfacePoint &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
      const double over_a = a.dot(other) - half, over_b = b.dot(other) - half;
      if (over_a <= 0) kept_.push_back(a);
      if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) kept_.push_back(a + over_a / (over_a - over_b) * (b - a));
    }
    corners_.swap(kept_);
  }
  double area() const {
    double twice = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const SurfacePoint &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
  }
  double reach() const {
    double most = 0;
    for (const SurfacePoint& c : corners_) most = std::max(most, c.squaredNorm());
    return std::sqrt(most);
  }

 private:
  std::vector<SurfacePoint> corners_, kept_;
};

}  // namespace detail

/// Areas [m2] of the cells, which fill the rectangle [0, width] x [0, height]; where it wraps the cells go round. Of two
/// points in one place the first has the whole cell.
inline std::vector<double> voronoi_areas(const std::vector<SurfacePoint>& points, double width, double height, bool wraps) {
  const std::size_t n = points.size();
  std::vector<double> areas(n, 0.0);
  if (n == 0) return areas;
  const double pitch = std::max(std::sqrt(width * height / double(n)), 1e-9 * (width + height));
  const auto bins = [&](double length) { return std::max(1L, long(length / pitch)); };
  const long across = bins(width), up = bins(height);
  const auto column = [&](double x) {
    const long c = long(std::floor(x / width * double(across)));
    return wraps ? ((c % across) + across) % across : std::clamp(c, 0L, across - 1);
  };
  const auto row = [&](double y) { return std::clamp(long(std::floor(y / height * double(up))), 0L, up - 1); };
  std::vector<std::vector<Index>> bin(std::size_t(across * up));
  for (Index k = 0; k < n; ++k) bin[std::size_t(row(points[k].y()) * across + column(points[k].x()))].push_back(k);

  const double least_bin = std::min(width / double(across), height / double(up));
  for (Index k = 0; k < n; ++k) {
    const SurfacePoint& p = points[k];
    detail::VoronoiCell cell(wraps ? -0.5 * width : -p.x(), wraps ? 0.5 * width : width - p.x(), -p.y(), height - p.y());
    bool covered = false;
    const long c0 = column(p.x()), r0 = row(p.y()), farthest = std::max(across, up);
    // Rings of bins outward, until none beyond can reach the cell.
    for (long ring = 0; ring <= farthest && !covered && double(ring - 1) * least_bin < 2 * cell.reach(); ++ring) {
      for (long r = r0 - ring; r <= r0 + ring; ++r) {
        if (r < 0 || r >= up) continue;
        const long stride = r == r0 - ring || r == r0 + ring ? 1 : std::max(1L, 2 * ring);
        for (long c = c0 - ring; c <= c0 + ring; c += stride) {
          if (!wraps && (c < 0 || c >= across)) continue;
          if (wraps && (c - c0 > across / 2 || c0 - c > (across - 1) / 2)) continue;  // each bin of the ring once
          for (const Index other : bin[std::size_t(r * across + ((c % across) + across) % across)]) {
            if (other == k) continue;
            SurfacePoint away = points[other] - p;
            if (wraps) away.x() -= width * std::round(away.x() / width);
            if (away.squaredNorm() <= 1e-24 * (width * width + height * height)) {
              covered = covered || other < k;
              continue;
            }
            cell.cut(away);
            if (wraps && n < 64)  // so few that a cell may meet the same neighbour from both sides
              for (const double turn : {-width, width}) cell.cut(away + SurfacePoint(turn, 0));
          }
        }
      }
    }
    areas[k] = covered ? 0.0 : cell.area();
  }
  return areas;
}

}  // namespace breccia
