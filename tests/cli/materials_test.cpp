// SPDX-License-Identifier: BSD-3-Clause
// Materials, parameters by pair of materials and scatter, as a user writes them.
#include <cmath>

#include "program.hpp"

namespace breccia::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class MaterialsInWorkflows : public Program {
 protected:
  static constexpr const char* head =
      R"(packing: {type: regular, lattice: sc, container: {shape: box, size: [8 mm, 8 mm, 16 mm]}, radius: 1 mm}
bonding: {tolerance: 0.01}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.3 %}
postprocessors: [{type: stress}, {type: damage}, {type: statistics}, {type: bond_statistics}]
)";
  static constexpr const char* law = R"(contact_law:
  type: elastic_brittle
  bond_modulus: 10 GPa
  stiffness_ratio: 3.7
  tensile_strength: 40 MPa
  shear_strength: 40 MPa
  friction: 0.5
)";
  static constexpr const char* two = R"(materials: {quartz: {density: 2650 kg/m3}, feldspar: {density: 2560 kg/m3}}
material_of: {shares: {quartz: 25 %, feldspar: 75 %}}
)";
  Json run(const std::string& arguments) const {
    const Result r = call("run " + arguments + " --output out --overwrite --threads 1");
    EXPECT_EQ(r.code, 0) << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / "out/summary.json")) : Json::object();
  }
};

TEST_F(MaterialsInWorkflows, TwoMineralsAsShipped) {
  const Json s = run(BRECCIA_SOURCE_DIR
                     "/workflows/examples/two_minerals.yaml --variant small --set renderers=[] --set outputs=[]");
  if (HasFailure()) return;
  const Json& materials = s["statistics"]["materials"];
  EXPECT_NEAR(materials["quartz"]["volume_share"].get<double>(), 0.35, 0.1);  // by whole grains
  EXPECT_EQ(materials["quartz"]["particles"].get<int>() + materials["feldspar"]["particles"].get<int>(), 600);
  const Json& by = s["damage"]["by_materials"];
  std::size_t made = 0, broken = 0;
  for (const auto& [name, of] : by.items()) {
    made += of["bonds_made"].get<std::size_t>();
    broken += of["broken"].get<std::size_t>();
  }
  EXPECT_EQ(by.size(), 3u);
  EXPECT_EQ(made, s["bonds"]);
  EXPECT_EQ(broken, s["damage"]["bonds_broken"]);
  const auto share = [&](const char* name) {
    return by[name]["broken"].get<double>() / by[name]["bonds_made"].get<double>();
  };
  EXPECT_GT(share("quartz-feldspar"), share("feldspar-feldspar"));  // their bonds have half the strength
  EXPECT_GT(s["peak_stress_Pa"], 0);
  // What it resolved to gives the same again.
  const std::string first = content(folder_ / "out/curves.csv");
  fs::copy(folder_ / "out/resolved.yaml", folder_ / "again.yaml");
  run("again.yaml");
  EXPECT_EQ(first, content(folder_ / "out/curves.csv"));
}

TEST_F(MaterialsInWorkflows, OneMaterialUnderTwoNamesIsOne) {
  write("one.yaml", std::string(head) + law + "material: {density: 2650 kg/m3}\n");
  write("two.yaml", std::string(head) + law +
                        "  between: [{materials: [a, b], friction: 0.5}]\n"
                        "materials: {a: {density: 2650 kg/m3}, b: {density: 2650 kg/m3}}\n"
                        "material_of: {layers: {materials: [a, b], thicknesses: [3 mm, 2 mm], dip: 30 deg}}\n");
  run("one.yaml");
  const std::string one = content(folder_ / "out/curves.csv");
  run("two.yaml");
  EXPECT_EQ(one, content(folder_ / "out/curves.csv"));
}

TEST_F(MaterialsInWorkflows, AllThatIsWrongIsSaidAtOnceWithItsPlace) {
  write("w.yaml", std::string(head) + R"(materials: {quartz: {density: 2650 kg/m3}, feldspar: {}}
material_of: {shares: {quartz: 25 %}, layers: {materials: [quartz], thicknesses: [1 mm, 2 mm]}}
contact_law:
  type: elastic_brittle
  bond_modulus: 10 GPa
  stiffness_ratio: 3.7
  tensile_strength: {mean: 40 MPa, distribution: weibul, modulus: 8}
  shear_strength: {mean: 40 MPa, distribution: weibull, coefficient_of_variation: 10 %}
  friction: {mean: 0.5, distribution: normal, standard_deviation: 0.1}
  between:
    - {materials: [quartz], tensile_strenght: 20 MPa}
    - {materials: [quartz, feldspar], type: viscous, bond_modulus: -1 GPa}
)");
  const Result r = call("validate w.yaml");
  EXPECT_EQ(r.code, 2) << r.text;
  for (const char* part :
       {"materials.feldspar.density: is missing", "give only one of `shares`", "must have at least 2 items, not 1",
        "`weibul` is not one of", "did you mean `weibull`?", "a weibull distribution goes by its `modulus`",
        "contact_law.friction: must be a plain number, not a mapping", "must have 2 items, not 1",
        "contact_law.between[0].tensile_strenght: is not a known parameter; did you mean `tensile_strength`?",
        "contact_law.between[1].type: cannot differ here", "contact_law.between[1].bond_modulus: must be above 0"})
    EXPECT_TRUE(has(r.text, part)) << part << "\n" << r.text;
}

/// What is wrong with a law itself is not said again for each pair of materials.
TEST_F(MaterialsInWorkflows, MistakesOfALawAreSaidOnce) {
  write("w.yaml", std::string(head) + law + "  between: [{materials: [quartz, feldspar]}]\n" + two);
  const Result r = call("validate w.yaml --set contact_law.bonds=3 --set contact_law.friction=null");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "contact_law.bonds: is not a known parameter")) << r.text;
  EXPECT_FALSE(has(r.text, "between[0]")) << r.text;
}

TEST_F(MaterialsInWorkflows, NamesAndSharesAreChecked) {
  write("w.yaml", std::string(head) + law + "  between: [{materials: [quarz, feldspar]}]\n" + two);
  const auto refused = [&](const std::string& settings, const std::string& why) {
    const Result r = call("validate w.yaml " + settings);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_TRUE(has(r.text, why)) << why << "\n" << r.text;
  };
  refused("", "contact_law.between[0].materials[0]: no material is named `quarz`; did you mean `quartz`?");
  refused("--set 'contact_law.between=[{materials: [quartz, feldspar]}, {materials: [feldspar, quartz]}]'",
          "contact_law.between[1].materials: the pair of `feldspar` and `quartz` stands in between[0] already");
  const std::string right = "--set contact_law.between[0].materials=[quartz,feldspar] ";
  EXPECT_EQ(call("validate w.yaml " + right).code, 0);
  refused(right + "--set material_of.shares.quartz='30 %'", "the shares add up to 105 %, not to 100 %");
  refused(right + "--set material_of='{column: {name: mineral, values: {quartz: 1, gold: 2}}}'",
          "material_of.column.values.gold: no material is named `gold`");
  refused(right + "--set 'material_of={layers: {materials: [quartz, feldspar], thickness: [1 mm, 2 mm]}}'",
          "material_of.layers.thickness: does not belong here; `thickness` belongs at the top level; or did you mean "
          "`thicknesses`?");
  refused(
      right + "--set material_of='{regions: [{material: quartz, sphere: {centre: [0 m, 0 m, 0 m], radius: 1 mm}}]}'",
      "material_of.elsewhere: is missing");
  const Result r = call("run w.yaml --output out " + right +
                        "--set material_of='{column: {name: mineral, values: {quartz: 1, feldspar: 2}}}'");
  EXPECT_EQ(r.code, 2);
  EXPECT_TRUE(has(r.text, "--set:2:29: material_of.column.name: the packing has no column `mineral`")) << r.text;
}

TEST_F(MaterialsInWorkflows, WhatScattersIsReportedAskedAndGot) {
  write("w.yaml",
        std::string(head) + law + "  between: [{materials: [quartz, feldspar], tensile_strength: 20 MPa}]\n" + two);
  const std::string weibull = "--set contact_law.tensile_strength='{mean: 40 MPa, distribution: weibull, modulus: 8}' ";
  const std::string uniform =
      "--set contact_law.shear_strength='{mean: 30 MPa, distribution: uniform, coefficient_of_variation: 0.2}' ";
  const Json s = run("w.yaml " + weibull + uniform);
  if (HasFailure()) return;
  const Json& scatter = s["elastic_brittle"]["scatter"];
  // Tensile strength where it scatters: between like and like; shear strength everywhere, kind by kind.
  ASSERT_EQ(scatter.size(), 5u) << scatter;
  std::size_t tensile = 0, shear = 0;
  for (const Json& one : scatter) {
    const bool in_tension = one["parameter"] == "tensile_strength";
    const std::size_t bonds = one["bonds"];
    (in_tension ? tensile : shear) += bonds;
    EXPECT_EQ(one["unit"], "Pa");
    EXPECT_EQ(one["materials"].size(), 2u);
    if (in_tension) { EXPECT_EQ(one["materials"][0], one["materials"][1]); }
    const double mean = in_tension ? 40e6 : 30e6, deviation = (in_tension ? 0.14837 : 0.2) * mean;
    EXPECT_EQ(one["mean"]["asked"].get<double>(), mean);
    EXPECT_NEAR(one["standard_deviation"]["asked"].get<double>(), deviation, 1e-4 * mean);
    EXPECT_NEAR(one["mean"]["got"].get<double>(), mean, 5 * deviation / std::sqrt(double(bonds)));
    EXPECT_NEAR(one["standard_deviation"]["got"].get<double>(), deviation, 5 * deviation / std::sqrt(double(bonds)));
    EXPECT_NE(one["mean"]["got"], one["mean"]["asked"]);
  }
  EXPECT_EQ(shear, s["bonds"]);
  EXPECT_LT(tensile, shear);
  const std::string log = content(folder_ / "out/run.log");
  EXPECT_TRUE(has(log, "shear_strength of ") && has(log, "mean asked 3e+07, got ")) << log;
  EXPECT_FALSE(run("w.yaml")["elastic_brittle"].contains("scatter"));
}

TEST_F(MaterialsInWorkflows, ValidateKnowsWhatAPackingCannotDo) {
  write("w.yaml", std::string(head) + law + "material: {density: 2650 kg/m3}\n");
  const Result r = call("validate w.yaml --set dimension=2");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "w.yaml:1:10: packing regular: in two dimensions the lattice is square or hexagonal"))
      << r.text;
}

/// Before a packing is made, which may take long.
TEST_F(MaterialsInWorkflows, ValidateKnowsWhatALawCannotDo) {
  write("w.yaml", std::string(head) + "material: {density: 2650 kg/m3}\n" +
                      "contact_law: {type: flat_joint, bond_modulus: 10 GPa, stiffness_ratio: 2, tensile_strength: "
                      "10 MPa, cohesion: 40 MPa, internal_friction_angle: 30 deg, friction: 0.5}\n");
  EXPECT_EQ(call("validate w.yaml").code, 0);
  const std::string in_plane = " --set dimension=2 --set packing.lattice=hexagonal";
  const Result r = call("run w.yaml" + in_plane);
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "w.yaml:7:14: contact_law flat_joint: `elements: disc_...` is how faces of spheres"))
      << r.text;
  EXPECT_FALSE(has(r.text, "particles")) << r.text;
  EXPECT_EQ(call("validate w.yaml --set contact_law.elements=line_4" + in_plane).code, 0);
}

}  // namespace
}  // namespace breccia::testing
