// SPDX-License-Identifier: BSD-3-Clause
/// Contacts of spheres in a space that may repeat itself after so little that a sphere touches images of itself.
#pragma once

#include "breccia/images.hpp"

namespace breccia::replicated_cell {

/// Gaps count as contact up to this share of the sum of the radii: files may have six digits.
inline constexpr double touching = 1e-3;

/// Calls f(i, j, branch) for each contact of each sphere, hence twice for every two that touch; `branch` leads from i
/// to the image of j [m].
template <class F>
void for_each_contact(const Space& space, const std::vector<Vec3>& x, const std::vector<double>& r, F&& f) {
  const double reach = 2 * (1 + touching) * *std::max_element(r.begin(), r.end());
  const Images all(space, x, reach);
  const CellGrid grid(all.position, reach);
  for (Index i = 0; i < x.size(); ++i)
    grid.for_each_near(all.position[i], [&](Index image) {
      const Index j = all.of[image];
      const Vec3 branch = all.position[image] - all.position[i];
      const double near = (1 + touching) * (r[i] + r[j]);
      if (image != i && branch.squaredNorm() <= near * near) f(i, j, branch);
    });
}

}  // namespace breccia::replicated_cell
