// SPDX-License-Identifier: BSD-3-Clause
/// What the workflow says about a packing by collective rearrangement.
#pragma once

#include <filesystem>

#include "breccia/packing.hpp"
#include "breccia/packing_tools/fit.hpp"

namespace breccia::collective_rearrangement {

struct MeshConfig {
  std::filesystem::path file;
  double length_unit = 1;  // [m]
  static void describe(Schema<MeshConfig>& s) {
    s.param("file", &MeshConfig::file).example("core.stl").doc("closed surface of triangles, .stl or .vtp");
    s.param("length_unit", &MeshConfig::length_unit)
        .unit("m")
        .above(0)
        .example("1 mm")
        .doc("what a 1 in the file stands for: these formats have no units");
  }
};

struct Config {
  std::optional<ContainerConfig> container;
  std::optional<MeshConfig> mesh;
  RadiusConfig radius;
  std::optional<long> particles;
  std::optional<double> porosity, neighbours_per_particle;
  double margin = 0;  // [m]
  bool flat_ends = true;
  double overlap_tolerance = 0, tolerance = 0;
  long max_iterations = 0;
};

}  // namespace breccia::collective_rearrangement
