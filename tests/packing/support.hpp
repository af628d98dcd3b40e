// SPDX-License-Identifier: BSD-3-Clause
/// Configurations of labra_onate as the parser would hand them over.
#pragma once

#include "host.hpp"
#include "labra_onate.hpp"

namespace breccia::labra_onate {

/// A cylinder of 10 mm x 12 mm with about 700 spheres at 25 % porosity.
inline Json small_cylinder() {
  return Json{{"container", {{"shape", "cylinder"}, {"diameter", 0.010}, {"height", 0.012}}},
              {"porosity", 0.25},
              {"radius",
               {{"distribution", "normal"},
                {"mean", 0.6e-3},
                {"standard_deviation", 0.12e-3},
                {"min", 0.3e-3},
                {"max", 1.0e-3}}},
              {"max_iterations", 200},
              {"tolerance", 1e-4}};
}

inline Json small_box() {
  Json j = small_cylinder();
  j["container"] = {{"shape", "box"}, {"size", {0.008, 0.009, 0.011}}};
  return j;
}

inline Json small_rectangle() {
  Json j = small_cylinder();
  j["container"] = {{"shape", "box"}, {"size", {0.020, 0.030}}};
  j["porosity"] = 0.14;
  return j;
}

inline PackedParticles pack(const Json& config, Host& host, std::uint64_t seed = 1, int dimension = 3) {
  const FactoryOf<LabraOnate> factory;
  const auto plugin = factory.create(config);
  return generate(dynamic_cast<Packing&>(*plugin), {{dimension, 0.5}, seed}, host);
}

}  // namespace breccia::labra_onate
