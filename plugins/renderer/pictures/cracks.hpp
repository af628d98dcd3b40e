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

/// What the largest disc stands for, of discs whose areas are in proportion to a bond field.
struct CrackScale {
  double radius = 0, value = 0;  ///< [m], and what that area is of the field
  std::string name, unit;        ///< of the field
};

/// Those that broke at `since` or later. `size_by`: `area`, or nothing: each has the radius of the smaller particle;
/// `energy`: areas in proportion to what was released, none below zero; or to the amounts of a bond field. Then `scale`
/// is used, or made: the largest disc is as large as the largest by radius. UserError when the file is not one of
/// bonds, or has no such field.
std::vector<BrokenBond> broken_bonds(vtkPolyData* bonds, const std::string& size_by, double since,
                                     std::optional<CrackScale>& scale);

/// Whether there are any.
bool has_broken_bonds(vtkPolyData* bonds);

}  // namespace breccia::pictures
