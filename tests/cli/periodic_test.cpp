// SPDX-License-Identifier: BSD-3-Clause
// A space that repeats itself, as a user writes it.
#include "program.hpp"

namespace breccia::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class PeriodicInWorkflows : public Program {
 protected:
  /// A cubic lattice with these bonds has Young's modulus E_c and no Poisson effect.
  static constexpr const char* lattice = R"(periodic: [x, y, z]
packing: {type: regular, lattice: sc, container: {shape: box, size: [10.3 mm, 10 mm, 12 mm]}, radius: 1 mm}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.01}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa,
              shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.5, rotational: 0.5}
protocol: {type: periodic_cell, axis: z, strain_rate: 20 1/s, lateral_pressure: 0 MPa, max_strain: 0.5 %}
postprocessors: [{type: stress}, {type: elastic_constants, stress: cell_axial_stress}, {type: energy}]
)";
  Json run(const std::string& arguments) const {
    const Result r = call("run " + arguments + " --output out --overwrite --threads 1");
    EXPECT_EQ(r.code, 0) << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / "out/summary.json")) : Json::object();
  }
};

TEST_F(PeriodicInWorkflows, ALatticeHasItsExactModulusInEveryTest) {
  write("cell.yaml", lattice);
  const Json s = run("cell.yaml");
  if (HasFailure()) return;
  EXPECT_NEAR(s["youngs_modulus_Pa"].get<double>(), 10e9, 1e-3 * 10e9);
  EXPECT_NEAR(s["poisson_ratio"].get<double>(), 0, 1e-3);
  EXPECT_LT(std::abs(s["energy_error"].get<double>()), 1e-3);
  EXPECT_EQ(s["particles"].get<int>(), 5 * 5 * 6);
  EXPECT_NEAR(s["packing"]["period_x"]["asked"].get<double>(), 10.3e-3, 1e-12);
  EXPECT_NEAR(s["packing"]["period_x"]["got"].get<double>(), 10e-3, 1e-12);
  EXPECT_NEAR(s["porosity"].get<double>(), 1 - M_PI / 6, 1e-9);
  // Without lateral strain, with a lateral pressure, pulled, along another axis, and between platens with free sides
  // of which there are none: always the same springs.
  for (const char* change : {"--set protocol.lateral=fixed", "--set protocol.lateral_pressure=5MPa",
                             "--set protocol.sense=tension --set protocol.max_strain=0.3% --set "
                             "'postprocessors=[{type: stress}, {type: elastic_constants, stress: cell_axial_stress, "
                             "sense: tension}, {type: energy}]'",
                             "--set protocol.axis=x"}) {
    const Json other = run(std::string("cell.yaml ") + change);
    if (HasFailure()) return;
    EXPECT_NEAR(other["youngs_modulus_Pa"].get<double>(), 10e9, 2e-3 * 10e9) << change;
    EXPECT_LT(std::abs(other["energy_error"].get<double>()), 5e-3) << change;
  }
}

/// A frame says after which lengths it repeats itself. Each copy goes through the same motion: only the order of sums
/// is another.
TEST_F(PeriodicInWorkflows, ACellBesideItselfDoesWhatTheCellDoes) {
  std::string text(lattice);
  text.replace(text.find("packing: {"), text.find("material:") - text.find("packing: {"),
               "packing: {type: collective_rearrangement, container: {shape: box, size: [7 mm, 8 mm, 9 mm]}, radius: "
               "{distribution: uniform, min: 0.5 mm, max: 0.8 mm}, porosity: 36 %, overlap_tolerance: 20 %}\n");
  const auto put = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  put("max_strain: 0.5 %", "max_strain: 0.05 %");
  put("lateral_pressure: 0 MPa", "lateral: fixed");
  put("20 1/s", "4 1/s");
  write("cell.yaml", text);
  const Json cell = run("cell.yaml --set 'outputs=[{type: vtk, interval: 1 s}]'");
  if (HasFailure()) return;
  fs::rename(folder_ / "out/particles_000000.vtp", folder_ / "cell.vtp");
  const Json block =
      run("cell.yaml --set 'packing={type: replicated_cell, file: cell.vtp, copies: {x: 2, y: 1, z: 3}}'");
  if (HasFailure()) return;
  EXPECT_EQ(block["particles"].get<int>(), 6 * cell["particles"].get<int>());
  EXPECT_EQ(block["bonds"].get<int>(), 6 * cell["bonds"].get<int>());
  EXPECT_EQ(block["packing"]["period_z"]["got"].get<double>(), 3 * 9e-3);
  EXPECT_NEAR(block["porosity"].get<double>(), cell["porosity"].get<double>(), 1e-12);
  EXPECT_EQ(block["coordination_number"], cell["coordination_number"]);
  for (const char* name : {"youngs_modulus_Pa", "poisson_ratio"})
    EXPECT_NEAR(block[name].get<double>(), cell[name].get<double>(), 3e-4 * cell[name].get<double>()) << name;
  for (const char* name : {"porosity", "contacts_per_particle", "radius_mean"}) {
    const Json& line = block["packing"][name];
    EXPECT_NEAR(line["got"].get<double>(), line["asked"].get<double>(), 1e-9 * line["asked"].get<double>()) << name;
  }
  // The frame alone is the cell again, and a column is cut out of it as of any other.
  const Json again = run("cell.yaml --set 'packing={type: from_file, file: cell.vtp}'");
  if (HasFailure()) return;
  EXPECT_NEAR(again["youngs_modulus_Pa"].get<double>(), cell["youngs_modulus_Pa"].get<double>(),
              1e-6 * cell["youngs_modulus_Pa"].get<double>());
  const std::string column =
      " --set 'periodic=[]' --set 'postprocessors=[{type: stress}]' --set 'protocol={type: uniaxial_compression, "
      "platen_velocity: 0.5 m/s, max_strain: 0.1 %}' --set 'packing={type: replicated_cell, file: cell.vtp, cut: "
      "{shape: cylinder, diameter: 15 mm, height: 30 mm}}'";
  EXPECT_GT(run("cell.yaml" + column)["particles"].get<int>(), 5 * cell["particles"].get<int>());
  const Result r =
      call("run cell.yaml --output none" + column + " --set packing.cut.height=30m --set packing.cut.diameter=15m");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "GB. More than 400 million particles cannot be had")) << r.text;
}

TEST_F(PeriodicInWorkflows, EveryResultHasItsUnitAsData) {
  write("cell.yaml", lattice);
  const Json s = run("cell.yaml");
  if (HasFailure()) return;
  EXPECT_EQ(s["units"]["youngs_modulus_Pa"], "Pa");
  EXPECT_EQ(s["units"]["elastic_constants.average.youngs_modulus_Pa"], "Pa");
  EXPECT_EQ(s["units"]["stress.volume_m3"], "m3");
  EXPECT_EQ(s["units"]["periodic_cell.edge_at_start_x_m"], "m");
  for (const auto& [key, unit] : s["units"].items()) {  // a path to a number
    const Json* at = &s;
    for (std::size_t begin = 0, dot = 0; at && begin <= key.size(); begin = dot + 1) {
      dot = std::min(key.find('.', begin), key.size());
      const auto next = at->find(key.substr(begin, dot - begin));
      at = next == at->end() ? nullptr : &*next;
    }
    EXPECT_TRUE(at && (at->is_number() || at->is_null() || at->is_array())) << key;
  }
  EXPECT_FALSE(s["units"].contains("poisson_ratio"));
  EXPECT_FALSE(s["units"].contains("particles"));
}

TEST_F(PeriodicInWorkflows, PlatensStandWhereItDoesNotRepeatItself) {
  std::string text(lattice);
  text.replace(text.find("[x, y, z]"), 9, "[x, y]");
  text.replace(
      text.find("protocol: {"), text.find("postprocessors") - text.find("protocol: {"),
      "protocol: {type: uniaxial_compression, platen_velocity: 0.1 m/s, platen_stiffness: 20 MN/m, max_strain: "
      "0.3 %}\n");
  text.replace(text.find(", {type: elastic_constants"),
               text.find(", {type: energy") - text.find(", {type: elastic_constants"), "");
  write("platens.yaml", text);
  const Json s = run("platens.yaml");
  if (HasFailure()) return;
  const Json& axial = s["uniaxial_compression"];
  EXPECT_NEAR(axial["cross_section_area_m2"].get<double>(), 1e-4, 1e-12) << "the cell's";
  Result r = call("run platens.yaml --output across --set 'periodic=[z]'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "across z")) << r.text;
  r = call(
      "run platens.yaml --output crushed --set 'periodic=[]' --set protocol.type=triaxial_compression --set "
      "'protocol.confining_pressure=1 TPa'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "times the modulus of the bonds")) << r.text;
  r = call(
      "run platens.yaml --output sides --set protocol.type=triaxial_compression --set "
      "protocol.confining_pressure=5MPa");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "no sides")) << r.text;
}

TEST_F(PeriodicInWorkflows, WhatCannotBeIsSaid) {
  write("cell.yaml", lattice);
  Result r = call("validate cell.yaml --set 'periodic=[x, w, x]'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "periodic[1]") && has(r.text, "not `w`")) << r.text;
  EXPECT_TRUE(has(r.text, "periodic[2]") && has(r.text, "twice")) << r.text;
  r = call("run cell.yaml --output open --set 'periodic=[x, y]'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "periodic_cell") && has(r.text, "[x, y, z]")) << r.text;
  r = call(
      "validate cell.yaml --set packing='{type: labra_onate, container: {shape: box, size: [8 mm, 8 mm, 8 mm]}, "
      "particles: 100, radius: {distribution: uniform, min: 0.5 mm, max: 0.9 mm}}'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "cannot fill a space that repeats itself")) << r.text;
  r = call("run cell.yaml --output far --set 'protocol.lateral_pressure=1 TPa'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "times the modulus of the bonds")) << r.text;
  r = call("run cell.yaml --output loose --set 'bonding.tolerance=-0.5'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "there are no bonds")) << r.text;
  r = call("run cell.yaml --output narrow --set 'packing.container.size=[4 mm, 10 mm, 10 mm]'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "two images")) << r.text;
  r = call("run cell.yaml --output strain --set 'postprocessors=[{type: bagi_strain}]'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "no outline")) << r.text;
}

}  // namespace
}  // namespace breccia::testing
