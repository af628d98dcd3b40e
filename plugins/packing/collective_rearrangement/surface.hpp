// SPDX-License-Identifier: BSD-3-Clause
/// Signed distance to a closed surface of triangles.
#pragma once

#include <array>
#include <vector>

#include "breccia/types.hpp"

namespace breccia::collective_rearrangement {

/// The sign is that of the pseudonormal at the nearest point, which is right at edges and corners too: Bærentzen &
/// Aanæs (2005), IEEE Trans. Vis. Comput. Graph. 11, 243-253. Nearest points are found in a tree of bounding boxes.
/// Exact but for rounding; may be used by any number of threads at a time.
class Surface {
 public:
  using Triangle = std::array<std::size_t, 3>;  ///< numbers of its corners, counterclockwise as seen from outside
  Surface(std::vector<Vec3> points, std::vector<Triangle> triangles);  // [m]

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

}  // namespace breccia::collective_rearrangement
