// SPDX-License-Identifier: BSD-3-Clause
// What is said of input that is almost surely wrong, and of a test that shows it; with the limits of `checks:`.
#include <regex>

#include "small_specimen.hpp"

namespace breccia::testing {
namespace {

class Checks : public Program {
 protected:
  static constexpr const char* workflow = R"(packing: {type: from_file, file: p.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.01}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.3 %}
postprocessors: [{type: stress}]
)";

  /// 4 x 4 x 8 spheres of radius 1 mm on a cubic lattice, all but `whole` of its sheets smaller; `more`: further rows.
  void lattice(int whole = 4, double upper = 0.8, const std::string& more = "") const {
    std::ostringstream csv;
    csv << "x,y,z,radius\n";
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          csv << 2 * i + 1 << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ',' << (j < whole ? 1 : upper) << '\n';
    write("p.csv", csv.str() + more);
    write("w.yaml", workflow);
  }
  Json summary() const { return Json::parse(content(folder_ / "out/summary.json")); }
  /// All warnings of a run with these settings, one a line; they are those of the terminal.
  std::string warnings(const std::string& settings = "") const {
    const Result r = call("run w.yaml --output out --overwrite --threads 1 " + settings);
    EXPECT_EQ(r.code, 0) << r.text;
    std::string all;
    const Json said = summary().at("warnings");
    for (const Json& w : said) all += w.get<std::string>() + "\n";
    EXPECT_EQ(all.empty(), r.text.find("warning: ") == std::string::npos) << r.text;
    return all;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Checks, NothingIsSaidOfASoundTest) {
  lattice();
  EXPECT_EQ(warnings(), "");
}

TEST_F(Checks, BondsAcrossWideGaps) {
  lattice();
  const std::string wide = "--set bonding='{gap: 4.1 mm}' ";
  EXPECT_TRUE(has(warnings(wide), "of the bonds span a gap wider than 1 times the sum"));
  EXPECT_FALSE(has(warnings(wide + "--set checks.wide_gap=3"), "span a gap"));
  EXPECT_FALSE(has(warnings(wide + "--set checks.bond_share=1"), "span a gap"));
}

TEST_F(Checks, ABondingGapInTheWrongUnitIsRefusedBeforeItNeedsAllMemory) {
  lattice(4, 0, [] {
    std::ostringstream more;
    for (int k = 0; k < 900; ++k) more << 2 * (k % 30) + 1 << ',' << 2 * (k / 30) + 11 << ",1,1\n";
    return more.str();
  }());
  const Result r = call("run w.yaml --output out --set bonding='{gap: 1 m}'");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "bonding.gap: within 1 m the 1028 particles have more than 700 neighbours each")) << r.text;
}

TEST_F(Checks, ACurveThatNobodyAddsIsMissedBeforeThePackingIsMade) {
  lattice();
  const std::string wanted =
      " --set 'postprocessors=[{type: stress}, {type: elastic_constants, strain: axial_strian, lateral: "
      "lateral_strain}]'";
  const Result r = call("validate w.yaml" + wanted);
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text,
                  "--set:1:33: postprocessor elastic_constants: there is no curve `axial_strian`; the curves of this "
                  "workflow are"))
      << r.text;
  EXPECT_EQ(call("validate w.yaml").code, 0);
}

TEST_F(Checks, ValuesFarFromAnyRockOrTestAreDoubtedWithTheirPlace) {
  lattice();
  const auto doubts = [&](const std::string& settings) {
    const Result r = call("validate w.yaml " + settings);
    EXPECT_EQ(r.code, 0) << r.text;
    return has(r.text, "warning: ") ? r.text : std::string();
  };
  EXPECT_EQ(doubts(""), "");
  // Unbreakable bonds, rough walls, dense powders and slow tests are nobody's slip.
  EXPECT_EQ(doubts("--set contact_law.tensile_strength='1e15 Pa' --set contact_law.friction=0 --set "
                   "material.density='20 t/m3' --set protocol.platen_velocity='1 um/s'"),
            "");
  const std::string path = "w.yaml:4:";
  write("w.yaml", std::regex_replace(std::string(workflow), std::regex("10 GPa"), "13.2 Pa"));
  const std::string modulus = doubts("");
  EXPECT_TRUE(has(modulus, path) && has(modulus, "contact_law.bond_modulus: 13.2 Pa is not plausible for a modulus"))
      << modulus;
  lattice();
  EXPECT_TRUE(has(doubts("--set contact_law.bond_modulus='1e20 Pa'"), "--set:1:26: contact_law.bond_modulus: 1e20 Pa"));
  EXPECT_TRUE(
      has(doubts("--set material.density='2.65 kg/m3'"), "2.65 kg/m3 is not plausible for a density (50 kg/m3"));
  EXPECT_TRUE(has(doubts("--set contact_law.friction=50"), "50 is not plausible for a coefficient of friction"));
  EXPECT_TRUE(has(doubts("--set protocol.platen_velocity='1 km/s'"), "is not plausible for a velocity"));
  EXPECT_TRUE(has(doubts("--set contact_law.tensile_strength='{mean: 40 Pa, distribution: weibull, modulus: 8}'"),
                  "contact_law.tensile_strength.mean: 40 Pa is not plausible for a strength"));
  write("study.yaml", "workflow: w.yaml\ngrid: {contact_law.friction: [0.5, 50, 60]}\n");
  const std::string study = call("validate study.yaml").text;
  EXPECT_TRUE(has(study, "study.yaml:2:36: contact_law.friction: 50 is not") && has(study, "60 is not plausible"))
      << study;
  EXPECT_FALSE(has(study, "0.5 is not"));
  EXPECT_EQ(doubts("--set contact_law.friction=50 --set checks.implausible_values=false"), "");
  EXPECT_TRUE(has(warnings("--set contact_law.friction=50"), "coefficient of friction"));  // in log and summary, too
}

TEST_F(Checks, WhatIsFoundWhileATestIsSetUpHasItsPlace) {
  lattice();
  const auto refused = [&](const std::string& command, const std::string& why) {
    const Result r = call(command);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_TRUE(has(r.text, why)) << why << "\n" << r.text;
  };
  const std::string brazilian = " --set 'protocol={type: brazilian, platen_velocity: 0.1 m/s}'";
  refused("run w.yaml --output out" + brazilian, "--set:1:10: protocol brazilian: the specimen must be a cylinder");
  const std::string laws =
      " --set 'contact_law=[{type: linear, contact_modulus: 1 GPa, stiffness_ratio: 2, friction: 0.5}, {type: "
      "flat_joint, elements: line_4, bond_modulus: 1 GPa, stiffness_ratio: 2, tensile_strength: 1 MPa, "
      "cohesion: 1 MPa, friction: 0.5}]'";
  refused("run w.yaml --output out" + laws,
          "--set:1:89: contact_law flat_joint: `elements: line_...` is how faces of discs");
  fs::remove(folder_ / "p.csv");
  refused("validate w.yaml", "w.yaml:1:34: packing from_file: cannot read ");
}

TEST_F(Checks, AStepThatTakesThePlatensThroughTheSpecimenIsRefused) {
  lattice();
  const Result r = call("run w.yaml --output out --set material.density='1e40 kg/m3'");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "check density, moduli and velocity for their units")) << r.text;
}

TEST_F(Checks, WhatCannotBeReckonedWithIsRefusedWithItsReason) {
  lattice();
  const auto refused = [&](const std::string& setting, const std::string& reason) {
    const Result r = call("run w.yaml --output out --overwrite " + setting);
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_TRUE(has(r.text, reason)) << r.text;
  };
  refused("--set material.density='1e-300 kg/m3'", "check radii and material.density");
  const auto spheres_of = [&](const std::string& power) {  // in millimetres
    write("p.csv", "x,y,z,radius\n1" + power + ",1" + power + ",1" + power + ",1" + power + "\n3" + power + ",1" +
                       power + ",1" + power + ",1" + power + "\n");
  };
  spheres_of("e-97");
  refused("", "p.csv, line 2: the radius is not between 1e-30 m and 1e30 m");
  spheres_of("e203");
  refused("", "p.csv, line 2: the centre is farther than 1e30 m from the origin");
  spheres_of("e-20");  // the reader has nothing against them
  refused("--set material.density='1e-270 kg/m3'", "check radii and material.density");
}

TEST_F(Checks, ParticlesWithoutABond) {
  lattice(3);
  EXPECT_TRUE(has(warnings(), "32 of 128 particles have no bond to the rest"));
  EXPECT_FALSE(has(warnings("--set checks.unbonded_share=0.3"), "have no bond"));
  EXPECT_FALSE(has(warnings("--set checks.stray_growth=10"), "times as long"));
}

TEST_F(Checks, ParticlesWithMoreVolumeThanTheSpecimen) {
  lattice(0, 1.6);
  EXPECT_TRUE(has(warnings(), "below zero"));
  const std::string off = warnings("--set checks.negative_porosity=false --set checks.deep_overlap=1");
  EXPECT_FALSE(has(off, "below zero") || has(off, "overlap by more")) << off;
}

TEST_F(Checks, AParticleThatSetsTheTimeStepIsNamedWithByHowMuch) {
  // By the bound of single particles, as it is said.
  const std::string bound = "--set engine.time_step=bound";
  lattice();
  ASSERT_EQ(warnings(bound), "");
  const double step = summary()["time_step_s"].get<double>();
  lattice(4, 0, "1.6062,1.6062,1.6062,0.05\n");  // bonded to the first
  const std::string said = warnings(bound);
  EXPECT_TRUE(has(said, "particle 128 of the packing (radius 5e-05 m, at 0.001606, 0.001606, 0.001606 m)")) << said;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(said, found, std::regex("time step ([0-9.e+]+) times shorter than it were without it")))
      << said;
  const double ratio = step / summary()["time_step_s"].get<double>();
  EXPECT_GT(ratio, 3);
  EXPECT_NEAR(std::stod(found[1]), ratio, 0.1 * ratio) << "the run without it tells by how much";
  EXPECT_FALSE(has(warnings("--set checks.time_step_ratio=1000"), "time step"));
}

TEST_F(Checks, AWallThatIsPenetrated) {
  lattice();
  const std::string soft =
      "--set protocol.platen_stiffness='20 kN/m' --set protocol.max_strain=10% --set protocol.platen_velocity='1 m/s' ";
  const std::string said = warnings(soft);
  EXPECT_TRUE(has(said, "of 2e+04 N/m is penetrated")) << said;
  EXPECT_FALSE(has(warnings(soft + "--set checks.wall_overlap=2"), "penetrated"));
}

TEST_F(Checks, PairsThatArePressedIntoEachOther) {
  lattice();
  const std::string loose = "--set bonding.tolerance=-0.5 --set protocol.max_strain=0.5% ";
  EXPECT_FALSE(has(warnings(loose), "into each other"));
  const std::string said = warnings(loose + "--set checks.pair_overlap=1e-4");
  EXPECT_TRUE(has(said, "into each other at the deepest")) << said;
}

TEST_F(Checks, PlatensThatAreFarTooFast) {
  lattice();
  const std::string fast = "--set protocol.platen_velocity='60 m/s' --set protocol.max_strain=0.5% ";
  const std::string said = warnings(fast + "--set checks.wall_speed=1e-4");
  EXPECT_TRUE(has(said, "a boundary moves at")) << said;
  EXPECT_TRUE(has(said, "not quasi-static")) << said;
  EXPECT_TRUE(has(said, "lower the velocity of the platens")) << said;
  const std::string off = warnings(fast + "--set checks='{wall_speed: 1e9, unbalanced_force: 1e9}'");
  EXPECT_FALSE(has(off, "a boundary moves at") || has(off, "not quasi-static")) << off;
}

/// Whole files, and the reason in all places, when the energy does not close.
TEST_F(Checks, EnergyThatDoesNotCloseWarnsThenEndsTheRun) {
  lattice();
  const std::string limits = "--set engine.energy_error_warning=1e-14 --set engine.energy_error_limit=";
  EXPECT_TRUE(has(warnings(limits + "1e9"), "energy does not close")) << "goes on, and says so";
  EXPECT_FALSE(summary()["interrupted"].get<bool>());
  const std::uint64_t whole = summary()["steps"].get<std::uint64_t>();

  const Result r = call("run w.yaml --output ended --threads 1 " + limits + "1e-13");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "energy does not close") && has(r.text, "the run ends here")) << r.text;
  const fs::path at = fs::exists(folder_ / "ended/summary.json") ? folder_ / "ended" : folder_ / "unfinished/ended";
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
  const Json s = Json::parse(content(at / "summary.json"));
  EXPECT_LT(s["steps"].get<std::uint64_t>(), whole);
  EXPECT_TRUE(has(s["warnings"].dump(), "the run ends here")) << s["warnings"];
  const std::string curves = content(at / "curves.csv");
  EXPECT_GE(std::count(curves.begin(), curves.end(), '\n'), 2) << curves;
}

class Stages : public SmallSpecimen {};

/// The platens go on closing, and no target in stress comes any more.
TEST_F(Stages, ATargetThatTheSpecimenFailsBeforeIsSaid) {
  write_small();
  const Result r = call(
      "run small.yaml --output out --threads 1 --set 'protocol.stages=[{axial_stress: 5 MPa}, {axial_stress: 3 GPa}]' "
      "--set protocol.max_strain=5%");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "stage 2 of 2 (axial_stress 3e+09) was not reached: the specimen has failed")) << r.text;
  const Json s = summary("out");
  EXPECT_EQ(s["uniaxial_compression"]["stopped_by"], "stress drop");
  EXPECT_EQ(s["uniaxial_compression"]["stages"].size(), 1u);
}

}  // namespace
}  // namespace breccia::testing
