// SPDX-License-Identifier: BSD-3-Clause
/// Voronoi cells of circles on a rectangle, flat or rolled up to a cylinder: how much of a surface each particle stands
/// for.
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

  /// Keeps what is nearer to the origin than to `other`; `lead`: square of the origin's radius less that of the
  /// other's.
  void cut(const SurfacePoint& other, double lead) {
    const double half = 0.5 * (other.squaredNorm() + lead);
    kept_.clear();
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const SurfacePoint &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
      const double over_a = a.dot(other) - half, over_b = b.dot(other) - half;
      if (over_a <= 0) kept_.push_back(a);
      if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0))
        kept_.push_back(a + over_a / (over_a - over_b) * (b - a));
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

/// Areas [m2] of the cells, which fill the rectangle [0, width] x [0, height]; where it wraps the cells go round. With
/// radii [m] the boundary of two cells is where tangents to both circles are equally long (power diagram: Aurenhammer
/// (1987), SIAM J. Comput. 16, 78-96), so that a small circle among large ones has a small cell, or none. Of two in one
/// place the larger has all.
inline std::vector<double> voronoi_areas(const std::vector<SurfacePoint>& points, double width, double height,
                                         bool wraps, const std::vector<double>& radii = {}) {
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
  const auto square = [&](Index k) { return radii.empty() ? 0.0 : radii[k] * radii[k]; };
  double largest = 0;
  for (Index k = 0; k < n; ++k) largest = std::max(largest, square(k));
  for (Index k = 0; k < n; ++k) {
    const SurfacePoint& p = points[k];
    const double own = square(k);
    detail::VoronoiCell cell(wraps ? -0.5 * width : -p.x(), wraps ? 0.5 * width : width - p.x(), -p.y(),
                             height - p.y());
    bool covered = false;
    const long c0 = column(p.x()), r0 = row(p.y()), farthest = std::max(across, up);
    const auto can_be_cut_from = [&](double distance) {
      const double reach = cell.reach();
      return distance < reach + std::sqrt(reach * reach + largest - own);
    };
    // Rings of bins outward, until none beyond can reach the cell.
    for (long ring = 0; ring <= farthest && !covered && can_be_cut_from(double(ring - 1) * least_bin); ++ring) {
      for (long r = std::max(0L, r0 - ring); r <= std::min(up - 1, r0 + ring); ++r) {
        const long stride = r == r0 - ring || r == r0 + ring ? 1 : std::max(1L, 2 * ring);
        for (long c = c0 - ring; c <= c0 + ring; c += stride) {
          if (!wraps && (c < 0 || c >= across)) continue;
          if (wraps && (c - c0 > across / 2 || c0 - c > (across - 1) / 2)) continue;  // each bin of the ring once
          for (const Index other : bin[std::size_t(r * across + ((c % across) + across) % across)]) {
            if (other == k) continue;
            SurfacePoint away = points[other] - p;
            const double lead = own - square(other);
            if (wraps) away.x() -= width * std::round(away.x() / width);
            if (away.squaredNorm() <= 1e-24 * (width * width + height * height)) {
              covered = covered || lead < 0 || (lead == 0 && other < k);
              continue;
            }
            cell.cut(away, lead);
            if (wraps && n < 64)  // so few that a cell may meet the same neighbour from both sides
              for (const double turn : {-width, width}) cell.cut(away + SurfacePoint(turn, 0), lead);
          }
        }
      }
    }
    areas[k] = covered ? 0.0 : cell.area();
  }
  return areas;
}

}  // namespace breccia
