// SPDX-License-Identifier: BSD-3-Clause
/// What can stand in a picture: spheres, cracks, platens, the specimen's outline.
#pragma once

#include "camera.hpp"
#include "cracks.hpp"

namespace breccia::pictures {

/// Spheres of one colour each.
void add_spheres(Scene& scene, const Spheres& spheres, const std::vector<Rgb>& colour);

/// What a plane through `point` cuts of them: discs.
void add_section(Scene& scene, const Spheres& spheres, const std::vector<Rgb>& colour, const Vec3& point,
                 const Vec3& normal);

/// A disc with a dark rim across each broken bond (a short bar in two dimensions), or a line, `line_width` [m] wide,
/// where it is seen from its edge.
void add_cracks(Scene& scene, const std::vector<BrokenBond>& cracks, const std::vector<Rgb>& colour, int dimension,
                const Projection& view, double line_width);

void add_slabs(Scene& scene, const std::vector<Slab>& slabs);

/// How far the shadow of an irregular specimen stands out of its particles, to fill what is free between them [m].
double shadow_gap(const Spheres& spheres);

/// The specimen as it was when loading began: a pale wall behind everything and thin edges, `line_width` [m] wide.
/// Of an irregular specimen the frame knows no surface: the shadow of its particles as they were then, `spheres`.
void add_outline(Scene& scene, const SpecimenShape& specimen, int dimension, const Projection& projection,
                 double line_width, const Spheres& spheres);

}  // namespace breccia::pictures
