// SPDX-License-Identifier: BSD-3-Clause
/// What a user can say of a picture of the specimen: from where it is seen and what is taken away.
#pragma once

#include <optional>

#include "breccia/schema.hpp"

namespace breccia::pictures {

enum class Looking { oblique, face, front, side, top };

struct CameraConfig {
  std::optional<Looking> view;
  std::optional<Vec3> direction, up;
  double zoom;

  static void describe(Schema<CameraConfig>& s) {
    s.param("view", &CameraConfig::view)
        .choice("oblique", Looking::oblique, "from the front right, slightly from above")
        .choice("face", Looking::face,
                "square to the plane of the load: along the axis of a disc, across the axis of others")
        .choice("front", Looking::front, "from -y, z upwards")
        .choice("side", Looking::side, "from +x, z upwards")
        .choice("top", Looking::top, "from +z, y upwards")
        .doc(
            "from where; if absent `face` for discs between platens, tension and bending, else `oblique`; two "
            "dimensions are seen from +z");
    s.param("direction", &CameraConfig::direction)
        .example("[1, -1, 0.5]")
        .doc("any other direction, from the specimen toward the reader; its length does not matter");
    s.param("up", &CameraConfig::up)
        .example("[0, 0, 1]")
        .doc("what points upwards in the picture; if absent z, or y where the view is along z");
    s.param("zoom", &CameraConfig::zoom)
        .at_least(0.2)
        .at_most(20)
        .fallback(1.0)
        .doc("magnification about the middle of the specimen; 1 shows all of it");
    s.at_most_one_of({"view", "direction"});
  }
};

/// A plane across the specimen.
struct PlaneConfig {
  std::optional<Vec3> normal;
  double offset;

  template <class C>
  static void describe_plane(Schema<C>& s) {
    s.param("normal", &C::normal)
        .example("[0, 1, 0]")
        .doc("normal of the plane; its length does not matter; if absent toward the reader");
    s.param("offset", &C::offset)
        .unit("m")
        .fallback(0.0)
        .doc("distance of the plane from the middle of the specimen, along the normal");
  }
};

struct SliceConfig : PlaneConfig {
  std::optional<double> thickness;
  static void describe(Schema<SliceConfig>& s) {
    describe_plane(s);
    s.param("thickness", &SliceConfig::thickness)
        .unit("m")
        .above(0)
        .example("5 mm")
        .doc(
            "of a slab, half of it on either side: spheres whose centres lie in it, and cracks. If absent spheres are "
            "cut by the plane as in a thin section, and of cracks a slab of 15 % of the specimen is shown");
  }
};

struct ClipConfig : PlaneConfig {
  static void describe(Schema<ClipConfig>& s) { describe_plane(s); }
};

/// How pictures of scenes are asked for; what is not said follows from the test.
struct SceneOptions {
  std::optional<CameraConfig> camera;
  std::optional<SliceConfig> slice;
  std::optional<ClipConfig> clip;
  std::optional<double> opacity, since;
  std::optional<std::string> size_by, title;
  std::optional<bool> platens, axes, time;
};

}  // namespace breccia::pictures
