// SPDX-License-Identifier: BSD-3-Clause
/// Radii and the space they are to fill, taken together.
#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "breccia/packing_tools/container.hpp"
#include "breccia/packing_tools/radius_distribution.hpp"

namespace breccia {

/// Sum of the volumes (areas in two dimensions) of the spheres, overlaps counted twice [m3], [m2].
inline double solid_measure(const std::vector<double>& radii, int dimension) {
  double sum = 0;
  for (const double r : radii) sum += dimension == 2 ? r * r : r * r * r;
  return sum * (dimension == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3);
}

/// Adds what is wrong with a plugin's parameters `container` (if it has one) and `radius`, alone and together.
inline void check_fit(const std::optional<ContainerConfig>& container, const RadiusConfig& radius, Issues& issues) {
  std::optional<Container> box;
  try {
    if (container) box = container->make();
  } catch (const UserError& e) { issues.push_back({"container", e.what()}); }
  try {
    const RadiusLaw law = radius.law();
    if (box && law.max > box->largest_radius())
      issues.push_back({"radius", "the largest radius does not fit into the container"});
  } catch (const UserError& e) { issues.push_back({"radius", e.what()}); }
}

}  // namespace breccia
