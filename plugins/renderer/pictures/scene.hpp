// SPDX-License-Identifier: BSD-3-Clause
/// What can stand in a picture: spheres, cracks, the specimen's outline.
#pragma once

#include "camera.hpp"

namespace breccia::pictures {

/// Spheres coloured by one value each.
void add_spheres(Scene& scene, const Spheres& spheres, const std::vector<double>& value, const ColourTable& colours);

/// A broken bond as a disc across it (a short bar in two dimensions).
struct Crack {
  Vec3 position, normal;  // [m], unit vector
  double radius = 0;      // [m]
  Rgb colour{};
};
void add_cracks(Scene& scene, const std::vector<Crack>& cracks, int dimension);

/// The specimen as it was when loading began: a pale wall behind everything and thin edges, `line_width` [m] wide.
/// Of an irregular specimen the frame knows no surface: nothing is drawn.
void add_outline(Scene& scene, const SpecimenShape& specimen, int dimension, const Projection& projection,
                 double line_width);

}  // namespace breccia::pictures
