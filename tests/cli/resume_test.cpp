// SPDX-License-Identifier: BSD-3-Clause
// A run that goes on from a checkpoint ends in the bits of one that was never stopped: for every plugin that is
// shipped, with other threads than before.
#include <algorithm>
#include <csignal>
#include <map>
#include <set>

#include "small_specimen.hpp"
#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Contents of all files that a test's results are made of; of the summary what does not tell of the computer.
std::map<std::string, std::string> results(const fs::path& folder) {
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

constexpr const char* spheres = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
damping: {translational: 0.5, rotational: 0.5}
)";
std::string discs_in(const std::string& container) {
  return "dimension: 2\nthickness: 10 mm\npacking: {type: tangent_discs, container: " + container +
         ", radius_min: 0.5 mm, radius_max: 0.9 mm}\n"
         "material: {density: 2650 kg/m3}\nbonding: {tolerance: 0.001}\n"
         "damping: {translational: 0.3, rotational: 0.3}\n";
}
constexpr const char* brittle = R"(contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7,
  tensile_strength: {mean: 4 MPa, distribution: weibull, modulus: 6}, shear_strength: 4 MPa, friction: 0.5}
)";
constexpr const char* strong = R"(contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7,
  tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
)";
constexpr const char* additions = R"(contact_law:
  - {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 4 MPa, shear_strength: 4 MPa,
     friction: 0.5}
  - {type: linear, contact_modulus: 2 GPa, stiffness_ratio: 2.5, friction: 0.3}
  - {type: hertz_mindlin, youngs_modulus: 5 GPa, poisson_ratio: 0.2, friction: 0.3, restitution: 0.7}
  - {type: viscous, normal_ratio: 0.1, stiffness_modulus: 10 GPa}
  - {type: rolling_resistance, rolling_friction: 0.1, rolling_modulus: 10 GPa, rolling_damping: 0.1}
)";
constexpr const char* damage_law =
    R"(contact_law: {type: elasto_damage_plastic, area_factor: 1, youngs_modulus: 28 GPa, poisson_ratio: 0.2,
  tensile_strength: 4 MPa, shear_strength: 8 MPa, internal_friction: 0.9, friction: 0.5, contact_damping: 0.9,
  softening_tension: 0.2, softening_shear: 0.2, failure: uncoupled, compressive_limits: [20 MPa, 45 MPa, 70 MPa],
  compressive_slope_ratios: [3, 12, 22]}
)";
constexpr const char* moments =
    R"(contact_law: {type: nonlinear_tension, normal_stiffness: 30 MN, shear_stiffness_ratio: 0.5,
  bending_ratio: 0.256, tensile_strain_limit: 0.02, tension_shape: 0.2, shear_strain_ratio: 3.5, shear_strain_cap_ratio: 10,
  internal_friction_angle: 45 deg, friction_angle: 39 deg, bond_width: 0.8}
)";
constexpr const char* cement = R"(contact_law: {type: linear_parallel_bond, bond_modulus: 20 GPa, stiffness_ratio: 2.5,
  tensile_strength: {mean: 8 MPa, distribution: normal, standard_deviation: 2 MPa, min: 1 MPa}, cohesion: 12 MPa}
)";
constexpr const char* beams = R"(contact_law: {type: beam_bond, bond_modulus: 20 GPa, poisson_ratio: 0.2,
  tensile_strength: 8 MPa, compressive_strength: 60 MPa, shear_strength: 20 MPa}
)";
constexpr const char* joints =
    R"(contact_law: {type: flat_joint, bond_modulus: 10 GPa, stiffness_ratio: 2.5, tensile_strength: 4 MPa, cohesion: 6 MPa,
  friction: 0.5, bonded_share: 80 %, gapped_share: 10 %, gap: 2 um}
)";
constexpr const char* softening =
    R"(contact_law: {type: soft_bond, bond_modulus: 10 GPa, stiffness_ratio: 2.5,
  tensile_strength: {mean: 2 MPa, distribution: weibull, modulus: 6}, fracture_energy: 2 J/m2, cohesion: 4 MPa,
  internal_friction_angle: 30 deg, friction: 0.5}
)";
constexpr const char* jointed =
    R"(material_of: {regions: [{material: upper, half_space: {point: [4 mm, 4 mm, 8 mm], normal: [1, 0, 1.5]}}], elsewhere: lower}
contact_law: {type: jcfpm, bond_modulus: 10 GPa, stiffness_ratio: 4, tensile_strength: 4 MPa, cohesion: 8 MPa,
  internal_friction_angle: 30 deg, friction: 0.5, between: [{materials: [upper, lower], smooth_joint: true,
  joint_normal: [1, 0, 1.5], tensile_strength: 0 MPa, cohesion: 0 MPa, dilation_angle: 5 deg}]}
)";
constexpr const char* outside = R"(
outputs: [{type: vtk, interval: 15 us}, {type: extxyz, interval: 20 us},
  {type: extxyz, name: packed, interval: 25 us, gzip: true}]
curves: {hdf5: true}
checkpoints: {every_steps: 40, keep: 100, at_end: true}
sampling: {every_steps: 7}
)";
constexpr const char* all_posts =
    "postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}, "
    "{type: damage}, {type: bond_statistics}, {type: fabric}, {type: energy}, "
    "{type: gauges}, {type: statistics}, {type: contact_stress}]\n";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// One of the cases has them: they are made from the other files.
const std::string pictures =
    fs::exists(BRECCIA_BINARY_DIR "/lib/breccia/breccia_renderer.pictures.so") ? "renderers: [{type: pictures}]\n" : "";

std::vector<Case> cases() {
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

class Resume : public SmallSpecimen, public ::testing::WithParamInterface<Case> {
 protected:
  void expect_same(const std::string& run, const std::string& other) const {
    const auto a = results(folder_ / run), b = results(folder_ / other);
    std::string names[2];
    for (const auto& [name, text] : a) names[0] += name + "\n";
    for (const auto& [name, text] : b) names[1] += name + "\n";
    EXPECT_EQ(names[0], names[1]);
    for (const auto& [name, text] : a)
      if (b.contains(name)) {
        EXPECT_TRUE(text == b.at(name)) << other << ": " << name << difference(text, b.at(name));
      }
  }
  static std::string difference(const std::string& a, const std::string& b) {
    const auto at = std::size_t(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
    return " at " + std::to_string(at) + ": " + a.substr(at, 60) + " <> " + b.substr(std::min(at, b.size()), 60);
  }
  std::vector<fs::path> checkpoints(const std::string& run) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_ / run / "checkpoints")) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
};

TEST_P(Resume, EndsInTheSameBits) {
  write_spheres();
  write("w.yaml", GetParam().text);
  const Result whole = call("run w.yaml --output whole --threads 1");
  ASSERT_EQ(whole.code, 0) << whole.text;
  const auto all = checkpoints("whole");
  ASSERT_GE(all.size(), 3u) << whole.text;
  // From near the beginning, from the middle, from the last step.
  for (const std::size_t from : {std::size_t(0), all.size() / 2, all.size() - 1}) {
    const std::string run = "from_" + std::to_string(from);
    fs::copy(folder_ / "whole", folder_ / run, fs::copy_options::recursive);
    for (std::size_t k = from + 1; k < all.size(); ++k) fs::remove(folder_ / run / "checkpoints" / all[k].filename());
    // Whatever was written after the checkpoint is not what it was: it must be written anew.
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole"))
      if (std::set<std::string>{".vtp", ".xyz", ".gz"}.contains(entry.path().extension()) &&
          fs::last_write_time(entry) > fs::last_write_time(all[from]))
        std::ofstream(folder_ / run / entry.path().lexically_relative(folder_ / "whole")) << "of later";
    const Result r = call("run --resume " + run + " --threads " + std::to_string(1 + from % 3));
    ASSERT_EQ(r.code, 0) << r.text;
    ASSERT_TRUE(has(r.text, "goes on from")) << r.text;
    expect_same("whole", run);
    EXPECT_EQ(checkpoints(run).size(), all.size()) << run;
  }
  // Checkpoints have no part in the test.
  const Result without = call("run w.yaml --output without --threads 2 --set checkpoints.keep=0");
  ASSERT_EQ(without.code, 0) << without.text;
  fs::remove(folder_ / "without/resolved.yaml");
  fs::remove(folder_ / "whole/resolved.yaml");
  expect_same("whole", "without");
}

INSTANTIATE_TEST_SUITE_P(Shipped, Resume, ::testing::ValuesIn(cases()), [](const auto& its) { return its.param.name; });

TEST(ResumeCases, HaveEveryPluginThatRuns) {
  std::string text;
  for (const Case& c : cases()) text += c.text;
  for (const auto& entry : fs::directory_iterator(BRECCIA_BINARY_DIR "/lib/breccia")) {
    const std::string file = entry.path().filename().string();
    for (const char* kind : {"contact_law", "protocol", "postprocessor", "output"}) {
      const std::string head = std::string("breccia_") + kind + ".";
      if (!file.starts_with(head)) continue;
      const std::string name = file.substr(head.size(), file.size() - head.size() - 3);
      EXPECT_TRUE(has(text, "{type: " + name)) << kind << " `" << name << "` is in no case of this test";
    }
  }
}

class SweepResume : public SweepProgram {};
class StoppedBySignal : public SweepProgram {};

TEST_F(StoppedBySignal, LeavesACheckpointAndGoesOn) {
  const std::string column = BRECCIA_SOURCE_DIR "/tests/torture/column.yaml";
  const std::vector<std::string> slowly = {"--set", "protocol.platen_velocity=0.3m/s", "--set",
                                           "checkpoints.every_steps=1000000"};
  const auto with = [&](const std::string& output) {
    std::vector<std::string> all = {"run", column, "--threads", "1", "--output", output};
    all.insert(all.end(), slowly.begin(), slowly.end());
    return all;
  };
  std::string words;
  for (const std::string& word : with("whole")) words += word + " ";
  const Result whole = call(words);
  ASSERT_EQ(whole.code, 0) << whole.text;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const std::string run = "stopped_" + std::to_string(signal);
    const pid_t child = start(with(run));
    const fs::path growing = folder_ / run / "unfinished";
    EXPECT_TRUE(within_a_minute([&] { return fs::exists(growing / "particles_000002.vtp"); }));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), 130) << "stopped before its end";
    EXPECT_TRUE(Json::parse(content(folder_ / run / "summary.json"))["interrupted"].get<bool>());
    const Result r = call("run --resume " + run + " --threads 2");
    ASSERT_EQ(r.code, 0) << r.text;
    EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
    const auto a = testing::results(folder_ / "whole"), b = testing::results(folder_ / run);
    for (const auto& [name, text] : a) EXPECT_TRUE(b.contains(name) && b.at(name) == text) << run << ": " << name;
    EXPECT_EQ(a.size(), b.size());
  }
}

TEST_F(SweepResume, ACaseGoesOnFromItsCheckpoint) {
  write("study.yaml",
        "workflows: [{name: soft, file: small.yaml}]\nfixed: {checkpoints.every_steps: 20}\n"
        "grid: {contact_law.stiffness_ratio: [2, 4]}\ncollect: [youngs_modulus_Pa]\n");
  ASSERT_EQ(call("sweep study.yaml --jobs 2").code, 0);
  const fs::path folder = case_of("study", results("study").at(1).at("folder"));
  const std::string curves = content(folder / "curves.csv"), table = content(folder_ / "results/study/results.csv");
  // As if it had been stopped.
  Json about = Json::parse(content(folder / "case.json"));
  about["status"] = "interrupted";
  std::ofstream(folder / "case.json") << about.dump();
  const Result r = call("sweep study.yaml --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "2 cases, 1 to run")) << r.text;
  EXPECT_TRUE(has(content(folder / "run.log"), "goes on from")) << content(folder / "run.log");
  EXPECT_EQ(content(folder / "curves.csv"), curves);
  EXPECT_EQ(content(folder_ / "results/study/results.csv"), table);
}

class Stopped : public SmallSpecimen {
 protected:
  void SetUp() override {
    SmallSpecimen::SetUp();
    write_small();
    ASSERT_EQ(call("run small.yaml --output whole " + often).code, 0);
  }
  std::string newest() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints"))
      names.insert(entry.path().filename().string());
    return "whole/checkpoints/" + *names.rbegin();
  }
  const std::string often = "--threads 1 --set checkpoints.every_steps=50 ";
};

TEST_F(Stopped, KeepsTheNewestOnly) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints")) ++count;
  EXPECT_EQ(count, 2u);
}

TEST_F(Stopped, OfADamagedOneTheOneBeforeIsUsed) {
  std::string bytes = content(folder_ / newest());
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder_ / newest(), std::ios::binary) << bytes;
  const Result r = call("run --resume whole");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "is damaged")) << r.text;
  EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
}

TEST_F(Stopped, APluginThatDoesNotSayIsNamed) {
  const std::string more = "plugins: ['" BRECCIA_BINARY_DIR "/tests/plugins/fixtures/faulty_postprocessor.so']\n";
  write("faulty.yaml", more + small);
  const Result r = call("run faulty.yaml --output faulty --set 'postprocessors=[{type: faulty}]' " + often);
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "postprocessor `faulty` does not say what changes in it while it runs")) << r.text;
  EXPECT_FALSE(fs::exists(folder_ / "faulty/checkpoints"));
}

TEST_F(Stopped, AFullDiskCostsTheCheckpointOnly) {
  // A limit of the size stands for the full disk: the curves fit, a checkpoint does not.
  const Result r = call("run small.yaml --output full " + often, "ulimit -f 200; trap '' XFSZ;");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "no checkpoint at step 50: cannot write")) << r.text;
  EXPECT_EQ(content(folder_ / "full/curves.csv"), content(folder_ / "whole/curves.csv"));
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "full"))
    EXPECT_FALSE(has(entry.path().filename().string(), ".h5")) << entry.path();
}

TEST_F(Stopped, WhatDoesNotBelongIsRefused) {
  Result r = call("run --resume nowhere");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "no checkpoint in")) << r.text;
  r = call("run --resume whole --set seed=3");
  EXPECT_NE(r.code, 0) << r.text;
  EXPECT_NE(call("run small.yaml --resume whole").code, 0);
  EXPECT_NE(call("run").code, 0);
  // Another workflow beside it.
  const std::string resolved = content(folder_ / "whole/resolved.yaml");
  std::ofstream(folder_ / "whole/resolved.yaml") << resolved << "\n# a remark\n";
  r = call("run --resume whole");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "is not the workflow")) << r.text;
  // Neither one is whole.
  for (const auto& entry : fs::directory_iterator(folder_ / "whole/checkpoints")) fs::resize_file(entry.path(), 700);
  r = call("run --resume whole");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text, "no usable checkpoint")) << r.text;
}

}  // namespace
}  // namespace breccia::testing
