// SPDX-License-Identifier: BSD-3-Clause
/// Casts parallel rays at spheres and flat patches: an exact depth for each ray, the nearest hit is seen. On the
/// processor alone: no OpenGL, the same bytes on every machine and for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "breccia/types.hpp"

namespace breccia::pictures {

using Rgb = std::array<unsigned char, 3>;

/// Where things in the specimen [m] stand in the picture: parallel rays, right-handed directions.
struct Projection {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), toward = Vec3::UnitZ();  ///< unit vectors; `toward` the reader
  double pixels_per_metre = 1;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< where the point 0, 0, 0 is seen [pixels from lower left]

  /// Right, up from the lower left corner, and toward the reader [pixels].
  Vec3 seen(const Vec3& x) const {
    return {origin.x() + pixels_per_metre * right.dot(x), origin.y() + pixels_per_metre * up.dot(x),
            pixels_per_metre * toward.dot(x)};
  }
};

struct Sphere {
  Vec3 centre;    // [m]
  double radius;  // [m]
  Rgb colour;
};

/// The points centre + u a + v b of a plane, with u² + v² <= 1 (round) or |u|, |v| <= 1.
struct Patch {
  Vec3 centre, a, b;  // [m]
  bool round = true;
  bool lit = true;      ///< else its colour is seen as it is
  bool behind = false;  ///< behind all that is not
  Rgb colour{};
};

struct Scene {
  std::vector<Sphere> spheres;
  std::vector<Patch> patches;
  bool occlusion = false;  ///< darkens gaps between spheres as diffuse light from everywhere would
  double opacity = 1;      ///< of the spheres: below 1, flat patches are seen through them
};

/// Red, green, blue of each pixel, rows from top to bottom.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
};

/// Rays through each pixel: this many squared, evenly spaced.
constexpr int rays_per_side = 3;

Image cast(const Scene& scene, const Projection& projection, int width, int height, const Vec3& background,
           int threads);

/// The share of the light from everywhere that a sphere keeps from a small flat area: `distance` of its centre in
/// radii (at least 1), `cosine` of the angle between the area's normal and the direction of that centre. Exact where
/// the sphere stands above the area's horizon and where it touches the area; an interpolation where it is cut by it.
inline float shadow_of_sphere(float distance, float cosine) {
  const float over = cosine * distance, square = distance * distance;
  if (over >= 1) return cosine / square;
  if (over <= -1) return 0;
  const float t = 0.5f * (1 + over), near = 1 / square, touching = near * near * near * near;
  return near / distance * t * (touching + (1 - touching) * t);
}

}  // namespace breccia::pictures
