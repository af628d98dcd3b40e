// SPDX-License-Identifier: BSD-3-Clause
/// Signed distance to a closed surface of triangles: for spaces that are no simple shape.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "breccia/types.hpp"

namespace breccia {

namespace detail {

constexpr std::size_t most_in_leaf = 4;
constexpr std::size_t most_waiting = 64;  // nodes: the tree is halved at each level

inline double square_distance(const Vec3& x, const Vec3& low, const Vec3& high) {
  return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace detail

/// The sign is that of the pseudonormal at the nearest point, which is right at edges and corners too: Bærentzen &
/// Aanæs (2005), IEEE Trans. Vis. Comput. Graph. 11, 243-253. Nearest points are found in a tree of bounding boxes.
/// Exact but for rounding; may be used by any number of threads at a time.
class ClosedSurface {
 public:
  using Triangle = std::array<std::size_t, 3>;  ///< numbers of its corners, counterclockwise as seen from outside
  ClosedSurface(std::vector<Vec3> points, std::vector<Triangle> triangles);  // [m]

  /// How far inside a point is, negative outside [m], and the direction in which that grows fastest.
  double depth(const Vec3& x, Vec3& inward) const;
  double volume() const;                             ///< [m3]
  const Vec3& low() const { return nodes_[0].low; }  ///< of the bounding box [m]
  const Vec3& high() const { return nodes_[0].high; }

 private:
  struct Node {
    Vec3 low, high;
    std::size_t first = 0, count = 0;  // triangles of a leaf; an inner node has none, and its children from `first` on
  };
  struct Nearest {
    double square;  // of the distance [m2]
    Vec3 point, normal;
  };

  void split(std::size_t node, std::size_t first, std::size_t end);
  void look_at(std::size_t triangle, const Vec3& x, Nearest& best) const;

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<Vec3> face_normal_, corner_normal_;
  std::vector<std::array<Vec3, 3>> edge_normal_;  // of the edge that follows each corner
  std::vector<Node> nodes_;
};

inline ClosedSurface::ClosedSurface(std::vector<Vec3> points, std::vector<Triangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), corner_normal_(points_.size(), Vec3::Zero()) {
  nodes_.emplace_back();
  split(0, 0, triangles_.size());
  std::map<std::pair<std::size_t, std::size_t>, Vec3> of_edge;
  const auto edge = [](std::size_t a, std::size_t b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const Triangle& t : triangles_) {
    const Vec3 normal = (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).normalized();
    face_normal_.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t here = t[k], next = t[(k + 1) % 3];
      const Vec3 a = points_[next] - points_[here], b = points_[t[(k + 2) % 3]] - points_[here];
      corner_normal_[here] += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;  // weighted with the angle
      of_edge.try_emplace(edge(here, next), Vec3::Zero()).first->second += normal;
    }
  }
  for (const Triangle& t : triangles_)
    edge_normal_.push_back({of_edge[edge(t[0], t[1])], of_edge[edge(t[1], t[2])], of_edge[edge(t[2], t[0])]});
}

inline double ClosedSurface::volume() const {
  double six = 0;
  for (const Triangle& t : triangles_)  // tetrahedra from a point nearby, for the sake of rounding
    six += (points_[t[0]] - low()).dot((points_[t[1]] - low()).cross(points_[t[2]] - low()));
  return six / 6;
}

inline void ClosedSurface::split(std::size_t node, std::size_t first, std::size_t end) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low, low_middle = low, high_middle = high;
  const auto middle = [&](const Triangle& t) { return Vec3((points_[t[0]] + points_[t[1]] + points_[t[2]]) / 3); };
  for (std::size_t k = first; k < end; ++k) {
    for (const std::size_t p : triangles_[k]) {
      low = low.cwiseMin(points_[p]);
      high = high.cwiseMax(points_[p]);
    }
    low_middle = low_middle.cwiseMin(middle(triangles_[k]));
    high_middle = high_middle.cwiseMax(middle(triangles_[k]));
  }
  nodes_[node] = {low, high, first, end - first};
  if (end - first <= detail::most_in_leaf) return;
  int along;
  (high_middle - low_middle).maxCoeff(&along);
  const std::size_t half = (first + end) / 2;
  const auto at = [&](std::size_t k) { return triangles_.begin() + std::ptrdiff_t(k); };
  std::nth_element(at(first), at(half), at(end), [&](const Triangle& a, const Triangle& b) {
    const double u = middle(a)[along], v = middle(b)[along];
    return u != v ? u < v : a < b;
  });
  const std::size_t child = nodes_.size();
  nodes_[node].first = child;
  nodes_[node].count = 0;
  nodes_.resize(child + 2);
  split(child, first, half);
  split(child + 1, half, end);
}

/// Regions of a triangle after Ericson (2005), Real-Time Collision Detection, section 5.1.5.
inline void ClosedSurface::look_at(std::size_t triangle, const Vec3& x, Nearest& best) const {
  const Triangle& t = triangles_[triangle];
  const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const auto take = [&](const Vec3& point, const Vec3& normal) {
    const double square = (x - point).squaredNorm();
    if (square < best.square) best = {square, point, normal};
  };
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return take(a, corner_normal_[t[0]]);
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return take(b, corner_normal_[t[1]]);
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return take(a + d1 / (d1 - d3) * ab, edge_normal_[triangle][0]);
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return take(c, corner_normal_[t[2]]);
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return take(a + d2 / (d2 - d6) * ac, edge_normal_[triangle][2]);
  const double of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6)
    return take(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), edge_normal_[triangle][1]);
  const double sum = of_a + of_b + of_c;
  take(a + of_b / sum * ab + of_c / sum * ac, face_normal_[triangle]);
}

inline double ClosedSurface::depth(const Vec3& x, Vec3& inward) const {
  Nearest best{std::numeric_limits<double>::infinity(), Vec3::Zero(), Vec3::Zero()};
  std::array<std::pair<double, std::size_t>, detail::most_waiting> waiting;
  std::size_t n = 0;
  waiting[n++] = {0.0, 0};
  while (n > 0) {
    const auto [square, at] = waiting[--n];
    if (square >= best.square) continue;
    const Node& node = nodes_[at];
    for (std::size_t k = 0; k < node.count; ++k) look_at(node.first + k, x, best);
    if (node.count > 0) continue;
    std::pair<double, std::size_t> near{0, node.first}, far{0, node.first + 1};
    near.first = detail::square_distance(x, nodes_[near.second].low, nodes_[near.second].high);
    far.first = detail::square_distance(x, nodes_[far.second].low, nodes_[far.second].high);
    if (far.first < near.first) std::swap(near, far);
    waiting[n++] = far;
    waiting[n++] = near;
  }
  const Vec3 out = x - best.point;
  const double distance = std::sqrt(best.square);
  const bool inside = out.dot(best.normal) < 0;
  // On the surface itself the difference is nothing but rounding.
  if (distance > 1e-12 * (high() - low()).norm()) inward = (inside ? 1 : -1) / distance * out;
  else inward = -best.normal.normalized();
  return inside ? distance : -distance;
}

}  // namespace breccia
