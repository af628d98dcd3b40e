// SPDX-License-Identifier: BSD-3-Clause
/// Regular (weighted Delaunay) triangulation of sphere centres, in three or two dimensions.
#pragma once

#include <array>
#include <vector>

#include "breccia/strided.hpp"
#include "breccia/types.hpp"

namespace breccia {

/// Tetrahedra (triangles in two dimensions), positively oriented.
struct Triangulation {
  int dimension = 3;
  std::vector<std::array<Index, 4>> simplices;  ///< corners; the fourth is unused in two dimensions
  std::size_t flat = 0;                         ///< left out because they have no volume

  int corners() const { return dimension + 1; }
};

/// The lower hull of the centres lifted to |x|^2 - r^2 (Edelsbrunner and Shah 1996), by Qhull. Spheres whose centre is
/// hidden by larger overlapping ones are no corner of any simplex. Cospherical centres, a lattice say, are cut into
/// simplices too. UserError when the centres span no volume or Qhull cannot cope with them.
Triangulation triangulate(int dimension, Strided<const Vec3> centre, Strided<const double> radius);

/// Takes simplices off the hull, from outside inward, that span a gap (edge minus both radii) wider than `limit` [m].
/// Returns how many.
std::size_t peel_hull(Triangulation& t, Strided<const Vec3> centre, Strided<const double> radius, double limit);

/// Volume times gradient of the linear shape function of each corner [m2]; without thickness in two dimensions [m].
std::array<Vec3, 4> shape_gradients(const Triangulation& t, std::size_t simplex, Strided<const Vec3> centre);

/// [m3]; area in two dimensions [m2].
double simplex_volume(const Triangulation& t, std::size_t simplex, Strided<const Vec3> centre);

}  // namespace breccia
