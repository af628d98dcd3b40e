// SPDX-License-Identifier: BSD-3-Clause
/// Small workflows in which every shipped plugin runs, and what their results are: for tests that hold for all of them.
#pragma once

#include <algorithm>
#include <map>
#include <set>

#include "fault_support.hpp"

namespace breccia::testing {

/// Contents of all files that a test's results are made of; of the summary what does not tell of the computer.
inline std::map<std::string, std::string> results_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_regular_file() || name == "run.log" || name == "breccia.json" || name.starts_with(".breccia"))
      continue;
    if (name.starts_with("checkpoints/")) continue;
    files[name] = content(entry.path());
    if (name != "summary.json") continue;
    files[name] = without_the_computers(Json::parse(files[name])).dump(1);
  }
  return files;
}

struct Case {
  std::string name, text;
};

inline constexpr const char* spheres = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
damping: {translational: 0.5, rotational: 0.5}
)";
inline std::string discs_in(const std::string& container) {
  return "dimension: 2\nthickness: 10 mm\npacking: {type: tangent_discs, container: " + container +
         ", radius_min: 0.5 mm, radius_max: 0.9 mm}\n"
         "material: {density: 2650 kg/m3}\nbonding: {tolerance: 0.001}\n"
         "damping: {translational: 0.3, rotational: 0.3}\n";
}
inline constexpr const char* brittle =
    R"(contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7,
  tensile_strength: {mean: 4 MPa, distribution: weibull, modulus: 6}, shear_strength: 4 MPa, friction: 0.5}
)";
inline constexpr const char* strong =
    R"(contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7,
  tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
)";
inline constexpr const char* additions = R"(contact_law:
  - {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 4 MPa, shear_strength: 4 MPa,
     friction: 0.5}
  - {type: linear, contact_modulus: 2 GPa, stiffness_ratio: 2.5, friction: 0.3}
  - {type: hertz_mindlin, youngs_modulus: 5 GPa, poisson_ratio: 0.2, friction: 0.3, restitution: 0.7}
  - {type: viscous, normal_ratio: 0.1, stiffness_modulus: 10 GPa}
  - {type: rolling_resistance, rolling_friction: 0.1, rolling_modulus: 10 GPa, rolling_damping: 0.1}
)";
inline constexpr const char* damage_law =
    R"(contact_law: {type: elasto_damage_plastic, area_factor: 1, youngs_modulus: 28 GPa, poisson_ratio: 0.2,
  tensile_strength: 4 MPa, shear_strength: 8 MPa, internal_friction: 0.9, friction: 0.5, contact_damping: 0.9,
  softening_tension: 0.2, softening_shear: 0.2, failure: uncoupled, compressive_limits: [20 MPa, 45 MPa, 70 MPa],
  compressive_slope_ratios: [3, 12, 22]}
)";
inline constexpr const char* moments =
    R"(contact_law: {type: nonlinear_tension, normal_stiffness: 30 MN, shear_stiffness_ratio: 0.5,
  bending_ratio: 0.256, tensile_strain_limit: 0.02, tension_shape: 0.2, shear_strain_ratio: 3.5, shear_strain_cap_ratio: 10,
  internal_friction_angle: 45 deg, friction_angle: 39 deg, bond_width: 0.8}
)";
inline constexpr const char* cement =
    R"(contact_law: {type: linear_parallel_bond, bond_modulus: 20 GPa, stiffness_ratio: 2.5,
  tensile_strength: {mean: 8 MPa, distribution: normal, standard_deviation: 2 MPa, min: 1 MPa}, cohesion: 12 MPa}
)";
inline constexpr const char* beams = R"(contact_law: {type: beam_bond, bond_modulus: 20 GPa, poisson_ratio: 0.2,
  tensile_strength: 8 MPa, compressive_strength: 60 MPa, shear_strength: 20 MPa}
)";
inline constexpr const char* joints =
    R"(contact_law: {type: flat_joint, bond_modulus: 10 GPa, stiffness_ratio: 2.5, tensile_strength: 4 MPa, cohesion: 6 MPa,
  friction: 0.5, bonded_share: 80 %, gapped_share: 10 %, gap: 2 um}
)";
inline constexpr const char* softening =
    R"(contact_law: {type: soft_bond, bond_modulus: 10 GPa, stiffness_ratio: 2.5,
  tensile_strength: {mean: 2 MPa, distribution: weibull, modulus: 6}, fracture_energy: 2 J/m2, cohesion: 4 MPa,
  internal_friction_angle: 30 deg, friction: 0.5}
)";
inline constexpr const char* jointed =
    R"(material_of: {regions: [{material: upper, half_space: {point: [4 mm, 4 mm, 8 mm], normal: [1, 0, 1.5]}}], elsewhere: lower}
contact_law: {type: jcfpm, bond_modulus: 10 GPa, stiffness_ratio: 4, tensile_strength: 4 MPa, cohesion: 8 MPa,
  internal_friction_angle: 30 deg, friction: 0.5, between: [{materials: [upper, lower], smooth_joint: true,
  joint_normal: [1, 0, 1.5], tensile_strength: 0 MPa, cohesion: 0 MPa, dilation_angle: 5 deg}]}
)";
inline constexpr const char* outside = R"(
outputs: [{type: vtk, interval: 15 us}, {type: extxyz, interval: 20 us},
  {type: extxyz, name: packed, interval: 25 us, gzip: true}]
curves: {hdf5: true}
checkpoints: {every_steps: 40, keep: 100, at_end: true}
sampling: {every_steps: 7}
)";
inline constexpr const char* all_posts =
    "postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}, "
    "{type: damage}, {type: bond_statistics}, {type: fabric}, {type: energy}, "
    "{type: gauges}, {type: statistics}, {type: contact_stress}]\n";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// One of the cases has them: they are made from the other files.
inline const std::string pictures =
    fs::exists(BRECCIA_BINARY_DIR "/lib/breccia/breccia_renderer.pictures.so") ? "renderers: [{type: pictures}]\n" : "";

inline std::vector<Case> cases() {
  const std::string end = std::string(all_posts) + outside;
  const std::string no_strain = std::string(
                                    "postprocessors: [{type: stress}, {type: energy}, {type: damage}, "
                                    "{type: contact_stress}]\n") +
                                outside;
  const std::string discs = discs_in("{shape: box, size: [12 mm, 18 mm]}"),
                    disc = discs_in("{shape: sphere, diameter: 14 mm}");
  return {
      {"uniaxial_compression",
       std::string(spheres) + brittle +
           "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, platen_stiffness: 15 MN/m, "
           "max_strain: 0.6 %}\n" +
           end},
      {"laws_that_add_up",
       std::string(spheres) + additions +
           "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, platen_stiffness: 15 MN/m, "
           "max_strain: 0.6 %}\nengine: {added_mass: 1 %}\n" +
           end},
      {"law_with_damage", std::string(spheres) + damage_law +
                              "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.3 %}\n" +
                              pictures + end},
      {"law_of_elements", std::string(spheres) + joints +
                              "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.8 %}\n" +
                              end},
      {"law_that_softens", std::string(spheres) + softening +
                               "protocol: {type: direct_tension, plate_velocity: 0.3 m/s, ramp_time: 5 us, grip: 2 mm, "
                               "max_strain: 0.2 %, stop_stress_ratio: 0}\n" +
                               no_strain},
      {"smooth_joint", replaced(spheres, "material: {density: 2650 kg/m3}",
                                "materials: {upper: {density: 2650 kg/m3}, lower: {density: 2650 kg/m3}}") +
                           jointed +
                           "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.6 %}\n" + end},
      {"triaxial_compression", std::string(spheres) + strong +
                                   "protocol: {type: triaxial_compression, platen_velocity: 1 m/s, stages: "
                                   "[{confining_pressure: 0.5 MPa}, {axial_strain: 0.2 %}, {hold_time: 5 us}, "
                                   "{axial_strain: 0.15 %}]}\n" +
                                   end},
      {"uniaxial_strain_compression", std::string(spheres) + brittle +
                                          "protocol: {type: uniaxial_strain_compression, platen_velocity: 1 m/s, "
                                          "max_strain: 1 %}\n" +
                                          end},
      {"biaxial_compression",
       discs + moments +
           "protocol: {type: biaxial_compression, confining_pressure: 1 MPa, platen_velocity: 1 m/s, "
           "max_strain: 0.2 %}\n" +
           end},
      {"brazilian",
       disc + brittle + "protocol: {type: brazilian, platen_velocity: 0.5 m/s, max_displacement: 0.2 %}\n" + no_strain},
      {"direct_tension", discs + moments +
                             "protocol: {type: direct_tension, plate_velocity: 0.5 m/s, ramp_time: 5 us, grip: 2 mm, "
                             "max_strain: 0.2 %}\n" +
                             no_strain},
      {"end_load",
       std::string(spheres) + cement +
           "protocol: {type: end_load, supports: [{at: lower, depth: 2 mm, holds: [all]}], loads: [{at: upper, "
           "depth: 2 mm, force: [60 N, 0 N, 0 N], moment: [0 N m, 0 N m, 0.05 N m]}], ramp_time: 60 us, "
           "duration: 20 us}\n" +
           no_strain},
      {"beams_that_swing",
       std::string(spheres) + beams +
           "protocol: {type: end_load, supports: [{at: lower, depth: 2 mm, holds: [all]}], loads: "
           "[{at: upper, depth: 2 mm, force: [60 N, 0 N, 0 N]}], ramp_time: 20 us, release_after: 5 "
           "us, duration: 40 us}\n" +
           no_strain},
      {"periodic_cell",
       std::string("periodic: [x, y, z]\npacking: {type: regular, lattice: fcc, container: {shape: box, "
                   "size: [10 mm, 10 mm, 12 mm]}, radius: 1 mm}\nmaterial: {density: 2650 kg/m3}\n"
                   "bonding: {tolerance: 0.01}\ndamping: {translational: 0.5, rotational: 0.5}\n") +
           brittle +
           "protocol: {type: periodic_cell, axis: z, strain_rate: 100 1/s, lateral_pressure: 1 MPa, "
           "max_strain: 0.3 %}\n" +
           no_strain},
  };
}

/// Where two files are not the same.
inline std::string difference(const std::string& a, const std::string& b) {
  const auto at = std::size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  return " at " + std::to_string(at) + ": " + a.substr(at, 60) + " <> " + b.substr(std::min(at, b.size()), 60);
}

/// For the results of a second run in a test's folder: the same files with the same bytes.
inline void expect_same_results(const fs::path& run, const fs::path& other) {
  const auto a = results_of(run), b = results_of(other);
  std::string names[2];
  for (const auto& [name, text] : a) names[0] += name + "\n";
  for (const auto& [name, text] : b) names[1] += name + "\n";
  EXPECT_EQ(names[0], names[1]) << other;
  for (const auto& [name, text] : a)
    if (b.contains(name)) { EXPECT_TRUE(text == b.at(name)) << other << ": " << name << difference(text, b.at(name)); }
}

inline std::vector<fs::path> checkpoints_of(const fs::path& run) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(run / "checkpoints")) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace breccia::testing
