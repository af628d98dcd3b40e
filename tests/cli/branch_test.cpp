// SPDX-License-Identifier: BSD-3-Clause
// `from`: a run begins where another one stood.
#include <algorithm>

#include "small_specimen.hpp"

namespace breccia::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A specimen that is confined, then compressed; a checkpoint every 20 steps.
class Branch : public SmallSpecimen {
 protected:
  void SetUp() override {
    SmallSpecimen::SetUp();
    write_spheres();
    write("trunk.yaml", std::string(head) + law + triaxial + posts);
    const Result r = call("run trunk.yaml --output trunk --threads 1");
    ASSERT_EQ(r.code, 0) << r.text;
    for (const auto& entry : fs::directory_iterator(folder_ / "trunk/checkpoints")) all_.push_back(entry.path());
    std::sort(all_.begin(), all_.end());
    ASSERT_GE(all_.size(), 6u);
  }
  std::string early() const { return "trunk/checkpoints/" + all_.front().filename().string(); }
  std::string confined() const { return "trunk/checkpoints/" + all_[all_.size() / 2].filename().string(); }
  std::string late() const { return "trunk/checkpoints/" + all_[all_.size() - 2].filename().string(); }
  void expect_refused(const std::string& arguments, const std::vector<std::string>& parts) const {
    const Result r = call("run " + arguments + " --output refused");
    EXPECT_EQ(r.code, 2) << r.text;
    for (const std::string& part : parts) EXPECT_TRUE(has(r.text, part)) << part << "\n" << r.text;
    EXPECT_FALSE(fs::exists(folder_ / "refused/summary.json"));
  }

  std::vector<fs::path> all_;
  static constexpr const char* head = R"(packing: {type: from_file, file: small.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
damping: {translational: 0.5, rotational: 0.5}
sampling: {every_steps: 5}
checkpoints: {every_steps: 20, keep: 1000, at_end: true}
)";
  static constexpr const char* law = R"(contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7,
  tensile_strength: {mean: 40 MPa, distribution: weibull, modulus: 6}, shear_strength: 40 MPa, friction: 0.5}
)";
  static constexpr const char* triaxial =
      "protocol: {type: triaxial_compression, platen_velocity: 1 m/s, confining_pressure: 1 MPa, max_strain: 0.3 %}\n";
  static constexpr const char* uniaxial =
      "protocol: {type: uniaxial_compression, platen_velocity: 1 m/s, max_strain: 0.3 %}\n";
  static constexpr const char* posts =
      "postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}]\n";
};

TEST_F(Branch, OfTheSameWorkflowIsTheSameTest) {
  for (const std::string& at : {early(), late()}) {
    const Result r = call("run trunk.yaml --from " + at + " --output same --overwrite --threads 2");
    ASSERT_EQ(r.code, 0) << r.text;
    EXPECT_TRUE(has(r.text, "goes on with the test of")) << r.text;
    EXPECT_EQ(content(folder_ / "same/curves.csv"), content(folder_ / "trunk/curves.csv")) << at;
    EXPECT_EQ(without_the_computers(summary("trunk")), without_the_computers(summary("same"))) << at;
  }
}

TEST_F(Branch, WhatMayDifferIsSaid) {
  const Result r = call("run trunk.yaml --from " + early() +
                        " --output other --set contact_law.friction=0.1 --set protocol.max_strain=0.2% "
                        "--set sampling.every_steps=10 --set engine.time_step_safety=0.5");
  ASSERT_EQ(r.code, 0) << r.text;
  for (const char* said : {"contact_law.friction: 0.5 there, 0.1 here",
                           "protocol.max_strain: ", "sampling.every_steps: ", "engine.time_step_safety: "})
    EXPECT_TRUE(has(r.text, said)) << said << "\n" << r.text;
  EXPECT_LT(summary("other")["time_step_s"].get<double>(), 0.7 * summary("trunk")["time_step_s"].get<double>());
  const auto last_strain = [&](const std::string& run) {
    return summary(run)["triaxial_compression"]["stages"].back();
  };
  EXPECT_NE(last_strain("other"), last_strain("trunk"));
  // The result says from where it came, and is had again from that.
  EXPECT_TRUE(has(content(folder_ / "other/resolved.yaml"), all_.front().filename().string()));
  ASSERT_EQ(call("run other/resolved.yaml --output again").code, 0);
  EXPECT_EQ(content(folder_ / "again/curves.csv"), content(folder_ / "other/curves.csv"));
}

TEST_F(Branch, AnotherTestBeginsOnTheSpecimenAsItIs) {
  write("unconfined.yaml", std::string(head) + "from: {checkpoint: " + confined() + "}\n" + law + uniaxial + posts);
  write("fresh.yaml", std::string(head) + law + uniaxial + posts);
  Result r = call("run unconfined.yaml --threads 1 --output unconfined");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "begins on the specimen of")) << r.text;
  ASSERT_EQ(call("run fresh.yaml --output fresh").code, 0);
  // Of a specimen that was compressed and is let go: less high, as stiff, and with a clock of its own.
  const Json a = summary("unconfined"), b = summary("fresh");
  const double modulus = b["youngs_modulus_Pa"].get<double>();
  EXPECT_NE(a["youngs_modulus_Pa"], b["youngs_modulus_Pa"]);
  EXPECT_NEAR(a["youngs_modulus_Pa"].get<double>(), modulus, 0.5 * modulus);
  EXPECT_NEAR(a["simulated_time_s"].get<double>(), b["simulated_time_s"].get<double>(),
              0.2 * b["simulated_time_s"].get<double>());
  EXPECT_EQ(a["bonds"], b["bonds"]);
  // A run of that kind goes on from its own checkpoints, to the same bits.
  std::vector<fs::path> own;
  for (const auto& entry : fs::directory_iterator(folder_ / "unconfined/checkpoints")) own.push_back(entry.path());
  std::sort(own.begin(), own.end());
  const std::string curves = content(folder_ / "unconfined/curves.csv");
  for (std::size_t k = own.size() / 2; k < own.size(); ++k) fs::remove(own[k]);
  r = call("run --resume unconfined --threads 2");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "goes on from")) << r.text;
  EXPECT_EQ(content(folder_ / "unconfined/curves.csv"), curves);
  // The same protocol may begin anew, too.
  r = call("run trunk.yaml --from " + confined() + " --set from.protocol=new --output once_more");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(has(r.text, "begins on the specimen of")) << r.text;
}

TEST_F(Branch, WhatMustAgreeIsCheckedAllAtOnce) {
  expect_refused(
      "trunk.yaml --from " + early() + " --set bonding.tolerance=0.2 --set 'material.density=2700 kg/m3' --set seed=4",
      {"bonding.tolerance: 0.15 there, 0.2 here; it must agree", "material.density: ", "seed: "});
  write("discs.csv", "x,y,z,radius\n1,1,1,1\n3,1,1,1\n5,1,1,1\n1,1,3,1\n");
  expect_refused("trunk.yaml --from " + early() + " --set packing.file=discs.csv", {"packing: its particles are not"});
  expect_refused(
      "trunk.yaml --from " + early() +
          " --set 'protocol={type: uniaxial_compression, platen_velocity: 1 m/s, "
          "max_strain: 0.3 %}' --set from.protocol=continue",
      {"there is no `uniaxial_compression` to continue, the checkpoint is of a test by `triaxial_compression`"});
  expect_refused("trunk.yaml --from nowhere", {"nowhere is neither a checkpoint nor a folder with one"});
  expect_refused("trunk.yaml --from trunk.yaml", {"is no checkpoint of Breccia"});
  EXPECT_EQ(call("validate trunk.yaml --set from.checkpoint=nowhere").code, 2);
}

TEST_F(Branch, ParametersDifferOnlyWhereTheLawAllows) {
  // Each bond has drawn its strength when it was made.
  expect_refused(
      "trunk.yaml --from " + early() + " --set contact_law.tensile_strength.modulus=3",
      {"contact_law: bonds and contacts keep what the law made of its parameters", "modulus: 6 there, 3 here"});
  expect_refused("trunk.yaml --from " + late() + " --set 'contact_law.bond_modulus=20 GPa'",
                 {"would at once store", "balance of energy is under way", "from.protocol: new"});
  expect_refused("trunk.yaml --from " + late() + " --set 'postprocessors=[{type: stress}, {type: fabric}]'",
                 {"postprocessors[1].type: bagi_strain there, fabric here", "cannot change after it"});
  // A new test keeps its own balance.
  for (const char* modulus : {"10 GPa", "20 GPa"}) {
    const Result r = call("run trunk.yaml --from " + confined() + " --set from.protocol=new --output " +
                          std::string(modulus, 2) + " --set 'contact_law.bond_modulus=" + modulus + "'");
    EXPECT_EQ(r.code, 0) << r.text;
  }
  EXPECT_GT(summary("20")["youngs_modulus_Pa"].get<double>(), 1.2 * summary("10")["youngs_modulus_Pa"].get<double>());
  const Result less = call("run trunk.yaml --from trunk --output less --set 'postprocessors=[{type: stress}]'");
  EXPECT_EQ(less.code, 0) << less.text;
}

TEST_F(Branch, CheckpointsMayFollowTheStrain) {
  const Result r = call(
      "run trunk.yaml --output strain --set checkpoints.every_strain=0.1% "
      "--set checkpoints.every_steps=1000000 --set checkpoints.at_end=false");
  ASSERT_EQ(r.code, 0) << r.text;
  const auto count = std::distance(fs::directory_iterator(folder_ / "strain/checkpoints"), fs::directory_iterator());
  EXPECT_GE(count, 1);
  EXPECT_LE(count, 3);
  write("disc.yaml",
        "dimension: 2\nthickness: 10 mm\npacking: {type: tangent_discs, container: {shape: sphere, diameter: 14 mm}, "
        "radius_min: 0.5 mm, radius_max: 0.9 mm}\nmaterial: {density: 2650 kg/m3}\nbonding: {tolerance: 0.001}\n" +
            std::string(law) + "protocol: {type: brazilian, platen_velocity: 0.5 m/s, max_displacement: 0.2 %}\n");
  const Result none = call("run disc.yaml --output none --set checkpoints.every_strain=0.1%");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_TRUE(has(none.text, "no curve of a strain along the axis")) << none.text;
  const Result hasty = call("validate trunk.yaml --set 'checkpoints.every=3 ms'");
  EXPECT_EQ(hasty.code, 2) << hasty.text;
  EXPECT_TRUE(has(hasty.text, "checkpoints.every: is time of the clock, and must be at least 1 s")) << hasty.text;
}

}  // namespace
}  // namespace breccia::testing
