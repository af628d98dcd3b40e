// SPDX-License-Identifier: BSD-3-Clause
/// From where a specimen is seen, and how much of it. Parallel projection: lengths can be read off the scale bar.
#pragma once

#include <span>

#include "caster.hpp"
#include "overlay.hpp"
#include "results.hpp"

namespace breccia::pictures {

/// Spheres to be shown: centres and radii [m].
struct Spheres {
  std::vector<Vec3> position;
  std::vector<double> radius;
};

class Viewpoint {
 public:
  /// Three-quarter view, slightly from above; straight on in two dimensions. Frames the specimen if its shape is known,
  /// with the spheres about it, otherwise all spheres: fragments that fly far do not shrink the rest.
  Viewpoint(const Spheres& spheres, const FrameFacts& facts);

  /// Width that suits a picture of this height, with room for a colour bar or legend [pixels].
  int width_for(int height) const;
  /// For a picture of this size [pixels].
  Projection aim(int width, int height);
  /// Fills in scale bar and directions. After `aim`.
  void annotate(Overlay& overlay) const;

  /// Whether a sphere lies within the frame. One that has flown out of it would end up over the writing.
  bool frames(const Vec3& x, double radius) const;

  Vec3 toward_reader() const { return toward_; }
  int dimension() const { return dimension_; }

 private:
  void include(const Vec3& x, double radius);
  void include(const SpecimenShape& specimen);

  int dimension_;
  Vec3 right_, up_, toward_;
  Vec3 low_, high_;  // of what is framed, along right, up, toward [m]
  double pixels_per_metre_ = 0;
};

}  // namespace breccia::pictures
