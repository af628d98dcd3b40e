// SPDX-License-Identifier: BSD-3-Clause
// Tests on lattices whose answer is known by hand, through the program.
#include <cmath>
#include <map>
#include <vector>

#include "program.hpp"

namespace breccia::testing {
namespace {

class Lattices : public Program {
 protected:
  Json run(const std::string& name, const std::string& text, int code = 0) {
    write(name + ".yaml", text);
    last_ = call("run " + name + ".yaml --output " + name + " --threads 1");
    EXPECT_EQ(last_.code, code) << last_.text;
    return last_.code == 0 ? Json::parse(content(folder_ / name / "summary.json")) : Json();
  }
  /// The columns of curves.csv.
  std::map<std::string, std::vector<double>> curves(const std::string& name) const {
    std::istringstream file(content(folder_ / name / "curves.csv"));
    std::map<std::string, std::vector<double>> columns;
    std::vector<std::string> order;
    bool first = true;
    for (std::string line; std::getline(file, line); first = false) {
      std::istringstream row(line);
      std::size_t k = 0;
      for (std::string cell; std::getline(row, cell, ','); ++k) {
        if (first) {
          order.push_back(cell);
          columns[cell];
        } else {
          columns[order[k]].push_back(std::stod(cell));
        }
      }
    }
    return columns;
  }
  Result last_;
};

const std::string cubes = R"(
packing:
  type: regular
  lattice: sc
  container: {shape: box, size: [8 mm, 8 mm, 24 mm]}
  radius: 1 mm
  gap: 0
material: {density: 2650 kg/m3}
bonding: {tolerance: 1e-6}
contact_law:
  type: elastic_brittle
  bond_modulus: 10 GPa
  stiffness_ratio: 3.7
  tensile_strength: 20 MPa
  shear_strength: 20 MPa
  friction: 0.5
damping: {translational: 0.5, rotational: 0.5}
sampling: {every_steps: 20}
postprocessors:
  - type: gauges
  - type: elastic_constants
    stress: platen_stress
    strain: platen_strain
    lateral: gauge_lateral_strain
    sense: tension
)";

/// Chains of bonds side by side: Young's modulus is the bonds', nothing couples the axes, strength is that of the
/// bonds.
TEST_F(Lattices, DirectTensionOfALattice) {
  const std::string tension =
      cubes + "protocol: {type: direct_tension, plate_velocity: 0.05 m/s, ramp_time: 100 us, time_after_peak: 30 us";
  for (const std::string moving : {"upper", "both"}) {
    const Json s = run(moving, tension + ", moving_plates: " + moving + "}\n");
    if (HasFailure()) return;
    EXPECT_NEAR(s["youngs_modulus_Pa"].get<double>(), 10e9, 0.01 * 10e9) << moving;
    EXPECT_NEAR(s["peak_stress_Pa"].get<double>(), 20e6, 0.03 * 20e6) << moving;
    EXPECT_NEAR(s["poisson_ratio"].get<double>(), 0, 0.005);
    EXPECT_TRUE(s["peak_reached"].get<bool>());
    const Json& own = s["direct_tension"];
    EXPECT_EQ(own["held_particles"]["lower"], 16) << "one layer";
    EXPECT_EQ(own["held_particles"]["upper"], 16);
    EXPECT_NEAR(own["free_length_m"].get<double>(), 22e-3, 1e-9);
    EXPECT_GT(own["protected_bonds"].get<int>(), 0);
    EXPECT_GE(own["time_after_peak_s"].get<double>(), 30e-6);
    EXPECT_EQ(own["stopped_by"], "stress drop");
    const auto c = curves(moving);
    ASSERT_TRUE(c.count("platen_strain") && c.count("gauge_axial_strain"));
    const std::size_t half = c.at("platen_strain").size() / 3;
    EXPECT_LT(c.at("platen_stress_Pa")[half], 0) << "tension is negative";
    EXPECT_LT(c.at("platen_strain")[half], 0);
    EXPECT_NEAR(c.at("gauge_axial_strain")[half] / c.at("platen_strain")[half], 1, 0.03)
        << "the strain is the same all along";
  }
}

/// Stress and strain of the particles, the defaults of elastic_constants: the forces of the grips count at the end
/// faces, and strain is that between them, however deep they reach.
TEST_F(Lattices, DirectTensionByTheDefaultColumns) {
  std::string defaults = cubes.substr(0, cubes.find("postprocessors:"));
  defaults += "postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants, sense: tension}]\n";
  for (const std::string grip : {"1 mm", "5 mm"}) {
    const Json s =
        run("grip_" + grip.substr(0, 1),
            defaults + "protocol: {type: direct_tension, plate_velocity: 0.05 m/s, ramp_time: 100 us, grip: " + grip +
                "}\n");
    if (HasFailure()) return;
    EXPECT_NEAR(s["youngs_modulus_Pa"].get<double>(), 10e9, 0.01 * 10e9) << grip;
    EXPECT_NEAR(s["peak_stress_Pa"].get<double>(), s["direct_tension"]["peak_tension_Pa"].get<double>(), 0.01 * 20e6);
    EXPECT_NEAR(s["peak_stress_Pa"].get<double>(), 20e6, 0.03 * 20e6) << grip;
  }
}

TEST_F(Lattices, DirectTensionBreaksWhereItMay) {
  // All bonds are equal, the layer is two bonds high: only those may break.
  const std::string tension = cubes + "protocol: {type: direct_tension, plate_velocity: 0.2 m/s, grip: 1.5 mm, ";
  const Json s = run("middle", tension + "breakable_layer: 0.2}\n");
  if (HasFailure()) return;
  const int all = 12 * 2 * 4 * 3 + 11 * 16;
  EXPECT_EQ(s["bonds"].get<int>(), all);
  EXPECT_EQ(s["direct_tension"]["protected_bonds"].get<int>(), all - (2 * 24 + 16))
      << "two layers of particles in 4.8 mm";
  EXPECT_EQ(s["direct_tension"]["broken_bonds_at_end"].get<int>(), 16)
      << "all between the two layers and none elsewhere";
  const Json none = run("everywhere", tension + "breakable_layer: 1}\n");
  EXPECT_EQ(none["direct_tension"]["protected_bonds"], 0);
}

TEST_F(Lattices, DirectTensionRefusals) {
  run("deep", cubes + "protocol: {type: direct_tension, plate_velocity: 0.1 m/s, grip: 13 mm}\n", 2);
  EXPECT_NE(last_.text.find("the grips meet"), std::string::npos) << last_.text;
  run("shallow", cubes + "protocol: {type: direct_tension, plate_velocity: 0.1 m/s, grip: 0.1 mm}\n", 2);
  EXPECT_NE(last_.text.find("within `grip`"), std::string::npos) << last_.text;
}

TEST_F(Lattices, BiaxialCompressionHoldsItsPressure) {
  const std::string discs = R"(
dimension: 2
packing:
  type: tangent_discs
  container: {shape: box, size: [20 mm, 30 mm]}
  radius_min: 0.3 mm
  radius_max: 0.9 mm
material: {density: 2900 kg/m3}
bonding: {tolerance: 0.001}
contact_law:
  type: nonlinear_tension
  normal_stiffness: 30 MN
  shear_stiffness_ratio: 0.5
  bending_ratio: 0.256
  tensile_strain_limit: 0.1
  tension_shape: 0.2
  shear_strain_ratio: 3.5
  shear_strain_cap_ratio: 10
  internal_friction_angle: 45 deg
  friction_angle: 39 deg
  bond_width: 0.8
damping: {translational: 0.3, rotational: 0.3}
postprocessors:
  - type: stress
protocol: {type: biaxial_compression, confining_pressure: 10 MPa, platen_velocity: 0.1 m/s, max_strain: 0.2 %}
)";
  const Json s = run("biaxial", discs);
  if (HasFailure()) return;
  const auto c = curves("biaxial");
  for (const char* name : {"stage", "lateral_stress_Pa", "confining_pressure_applied_Pa", "platen_stress_Pa"})
    ASSERT_TRUE(c.count(name)) << name;
  std::size_t loaded = 0;
  for (std::size_t k = 0; k < c.at("stage").size(); ++k) {
    if (c.at("stage")[k] < 1) continue;
    ++loaded;
    EXPECT_NEAR(c.at("confining_pressure_applied_Pa")[k], 10e6, 0.01 * 10e6) << k;
    EXPECT_NEAR(c.at("lateral_stress_Pa")[k], 10e6, 0.03 * 10e6) << k << ": measured inside, from the contact forces";
  }
  EXPECT_GT(loaded, 10u);
  EXPECT_GT(c.at("platen_stress_Pa").back(), 30e6) << "the platens go on";
  run("solid", cubes + "protocol: {type: biaxial_compression, confining_pressure: 10 MPa, platen_velocity: 0.1 m/s}\n",
      2);
  EXPECT_NE(last_.text.find("triaxial_compression"), std::string::npos) << last_.text;
}

}  // namespace
}  // namespace breccia::testing
