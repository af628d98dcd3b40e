// SPDX-License-Identifier: BSD-3-Clause
/// From where a specimen is seen, and how much of it. Parallel projection: lengths can be read off the scale bar.
#pragma once

#include "caster.hpp"
#include "overlay.hpp"
#include "scene_config.hpp"
#include "test_setup.hpp"

namespace breccia::pictures {

/// Unit vectors, square to each other.
struct Direction {
  Vec3 toward, up;  ///< the reader; in the picture
};
/// `face`: where the user says nothing, the view square to the plane of the load.
Direction direction_of(const CameraConfig& camera, const TestSetup& setup, bool face);

/// Of a platen that is drawn as a slab: its eight corners are centre ± a ± b ± c.
struct Slab {
  Vec3 centre, a, b, c;  // [m]
};
std::vector<Slab> slabs_of(const TestSetup& setup);
/// The line that stands for a load ends at its tip and is this share of the specimen's largest extent long.
constexpr double arrow_share = 0.16;

class Viewpoint {
 public:
  /// Frames the specimen if its shape is known, with the spheres, platens and loads about it, otherwise all spheres:
  /// fragments that fly far do not shrink the rest.
  Viewpoint(const Spheres& spheres, const TestSetup& setup, const Direction& direction, double zoom, bool platens);

  /// Size of the picture, with room for a colour bar or legend, and for a title [pixels]. `size`: the height that it
  /// has unless it is much wider than high.
  struct Paper {
    int width, height;
    double unit;  ///< a hundredth of `size`: writing is as large as in the others
  };
  Paper paper(int size, bool titled) const;
  /// For a picture of this size.
  Projection aim(const Paper& paper, bool titled);
  /// Fills in scale bar and directions. After `aim`.
  void annotate(Overlay& overlay, bool directions) const;

  /// Whether a sphere lies within the frame. One that has flown out of it would end up over the writing.
  bool frames(const Vec3& x, double radius) const;

  const Direction& direction() const { return direction_; }
  int dimension() const { return dimension_; }

 private:
  void include(const Vec3& x, double radius);
  void include(const SpecimenShape& specimen);

  int dimension_;
  Direction direction_;
  Vec3 right_;
  Vec3 low_, high_;  // of what is framed, along right, up, toward [m]
  double pixels_per_metre_ = 0;
};

}  // namespace breccia::pictures
