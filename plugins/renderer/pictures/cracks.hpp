// SPDX-License-Identifier: BSD-3-Clause
/// The broken bonds of a frame.
#pragma once

#include <optional>

#include "results.hpp"

namespace breccia::pictures {

struct BrokenBond {
  Vec3 position, normal;  ///< [m], unit vector across the crack
  double radius;          ///< as it is drawn [m]
  double time;            ///< of breakage [s]
  std::size_t mode;       ///< 0 tension, 1 shear, 2 combined
};

/// Those that broke at `since` or later. `size_by`: a bond field that the areas of the discs are in proportion to, the
/// largest as large as the largest by radius; empty: each has the radius of the smaller particle. UserError when the
/// file is not one of bonds, or has no such field.
std::vector<BrokenBond> broken_bonds(vtkPolyData* bonds, const std::string& size_by, double since);

/// Whether there are any.
bool has_broken_bonds(vtkPolyData* bonds);

}  // namespace breccia::pictures
