// SPDX-License-Identifier: BSD-3-Clause
/// Small specimens and laws for tests of the engine.
#pragma once

#include <memory>
#include <random>

#include "breccia/contact_law.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "plugin/registry.hpp"

namespace breccia::testing {

inline Json elastic_brittle(Json changes = Json::object()) {
  Json config = {{"model", "model_1"},
                 {"bond_modulus", 10e9},
                 {"stiffness_ratio", 3.7},
                 {"tensile_strength", 40e6},
                 {"shear_strength", 40e6},
                 {"friction", 0.5},
                 {"broken_rest_length", "initial_distance"}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}

/// Ouyang et al. (2017), Table 2, with the modulus of the law above.
inline Json nonlinear_tension(Json changes = Json::object()) {
  Json config = {{"bond_modulus", 10e9},         {"shear_stiffness_ratio", 0.5},   {"bending_ratio", 0.256},
                 {"tensile_strain_limit", 4e-3}, {"tension_shape", 0.2},           {"bond_width", 0.8},
                 {"shear_strain_ratio", 3.5},    {"shear_strain_cap_ratio", 10.0}, {"internal_friction_angle", 0.785},
                 {"friction_angle", 0.681}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}

/// The law as a user gets it: from its shared library.
inline std::unique_ptr<ContactLaw> make_law(const Json& config = elastic_brittle(),
                                            const std::string& name = "elastic_brittle") {
  static Registry registry;
  return registry.create<ContactLaw>({name, config});
}

/// nx x ny x nz equal spheres of radius r, exactly tangent, one corner sphere's centre at (r, r, r).
inline PackedParticles simple_cubic(int nx, int ny, int nz, double r) {
  PackedParticles p;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        p.position.emplace_back(r * (2 * i + 1), r * (2 * j + 1), r * (2 * k + 1));
        p.radius.push_back(r);
      }
  p.outline = SpecimenShape::Outline::box;
  return p;
}

/// A box of overlapping spheres of different sizes near the points of a disturbed lattice: dense, irregular, quick.
inline PackedParticles random_block(int nx, int ny, int nz, double r, unsigned seed) {
  PackedParticles p = simple_cubic(nx, ny, nz, r);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  for (std::size_t k = 0; k < p.position.size(); ++k) {
    for (int c = 0; c < 3; ++c) p.position[k][c] += 0.3 * r * (uniform() - 0.5);
    p.radius[k] *= 0.85 + 0.3 * uniform();
  }
  return p;
}

struct Bench {
  std::unique_ptr<ContactLaw> law;
  std::unique_ptr<Simulation> simulation;
  Simulation* operator->() { return simulation.get(); }
  void steps(int n) {
    for (int k = 0; k < n; ++k) {
      if (!simulation->forces_known()) simulation->forces();  // measured between the two halves of a step
      simulation->advance();
    }
  }
};

inline Bench make_bench(const PackedParticles& packing, const Json& law, double tolerance, EngineSettings settings = {},
                        int dimension = 3, const std::string& name = "elastic_brittle") {
  Bench b;
  b.law = make_law(law, name);
  b.simulation = std::make_unique<Simulation>(assemble(packing, {2650}, dimension, 1.0), *b.law, settings);
  b.simulation->bond({GapMeasure::relative, tolerance, std::nullopt});
  return b;
}

}  // namespace breccia::testing
