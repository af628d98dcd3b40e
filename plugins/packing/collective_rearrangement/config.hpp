// SPDX-License-Identifier: BSD-3-Clause
/// What the workflow says about a packing by collective rearrangement.
#pragma once

#include "breccia/packing.hpp"
#include "breccia/packing_tools/fit.hpp"
#include "breccia/packing_tools/triangle_mesh.hpp"

namespace breccia::collective_rearrangement {

struct Config {
  std::optional<ContainerConfig> container;
  std::optional<MeshConfig> mesh;
  RadiusConfig radius;
  std::optional<long> particles;
  std::optional<double> porosity, neighbours_per_particle;
  std::optional<double> margin;               // [m]
  std::optional<std::vector<double>> vessel;  // [m]
  bool flat_ends = true;
  double overlap_tolerance = 0, tolerance = 0;
  long max_iterations = 0;
};

}  // namespace breccia::collective_rearrangement
