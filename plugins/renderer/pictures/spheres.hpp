// SPDX-License-Identifier: BSD-3-Clause
/// Spheres to be shown, and what is taken away of them.
#pragma once

#include "results.hpp"

namespace breccia::pictures {

struct Spheres {
  std::vector<Vec3> position;       // [m]
  std::vector<double> radius;       // [m]
  std::vector<std::size_t> number;  ///< in the file

  std::size_t size() const { return radius.size(); }
  /// Keeps those for which `shown(centre, radius)` holds.
  template <class F>
  void keep(F&& shown) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < size(); ++p) {
      if (!shown(position[p], radius[p])) continue;
      position[kept] = position[p];
      radius[kept] = radius[p];
      number[kept++] = number[p];
    }
    position.resize(kept);
    radius.resize(kept);
    number.resize(kept);
  }
};

Spheres spheres_of(vtkPolyData* particles);

}  // namespace breccia::pictures
