// SPDX-License-Identifier: BSD-3-Clause
/// What can stand in a picture: spheres, cracks, the specimen's outline; and the light on it.
#pragma once

#include <vtkLookupTable.h>

#include "camera.hpp"
#include "style.hpp"

namespace breccia::pictures {

/// Soft light from the upper left with a fill from the right: shapes are seen, colours stay readable.
void add_lights(vtkRenderer* renderer);

/// Spheres coloured by one value each.
void add_spheres(vtkRenderer* renderer, const Spheres& spheres, const std::vector<double>& value,
                 vtkLookupTable* colours);

/// Darkens gaps between spheres as diffuse light would: depth can be seen.
void add_occlusion(vtkRenderer* renderer, const Spheres& spheres);

/// A broken bond as a disc across it (a short bar in two dimensions).
struct Crack {
  Vec3 position, normal;  // [m], unit vector
  double radius = 0;      // [m]
  Rgb colour{};
};
void add_cracks(vtkRenderer* renderer, const std::vector<Crack>& cracks, int dimension);

/// The specimen as it was when loading began: a pale back wall and thin edges.
void add_outline(vtkRenderer* renderer, const SpecimenShape& specimen, int dimension, double line_width);

}  // namespace breccia::pictures
