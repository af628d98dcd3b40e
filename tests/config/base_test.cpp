// SPDX-License-Identifier: BSD-3-Clause
/// Workflows that build on other files. Expected values are those of the one file that a user would write instead.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "config/base_chain.hpp"
#include "config/reader.hpp"
#include "config/writer.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

class Bases : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("breccia_bases_" + std::string(test->name()) + std::to_string(getpid()));
    fs::create_directories(folder_ / "shared");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  Json read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_config(text, (folder_ / "workflow.yaml").string(), fake::root(), fake::Plugins(), overrides,
                       fake::rules);
  }
  /// The messages, with the folder left out.
  std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    std::string all;
    try {
      return "no problem: " + read(text, overrides).dump();
    } catch (const ConfigError& error) { all = error.what(); }
    const std::string folder = folder_.string() + "/";
    for (std::size_t at = all.find(folder); at != std::string::npos; at = all.find(folder))
      all.erase(at, folder.size());
    return all;
  }

  fs::path folder_;
};

constexpr const char* specimen = R"(title: specimen 1
seed: 7
specimen: {diameter: 23 mm, slenderness: 2, porosity: 23 %}
levels: [1 MPa, 2 MPa, 3 MPa]
contact_law: {type: brittle, bond_modulus: 10 GPa, tensile_strength: 40 MPa, friction: 0.3}
postprocessor: [{type: stress, every: 2 ms}, {type: stress, name: second, symmetric: false}]
expected: {source: a paper, peaks: {first: 1, second: 2}}
quick: 1
)";

TEST_F(Bases, MappingsMergeAndTheRestIsReplaced) {
  write("base.yaml", specimen);
  const Json got = read(R"(base: base.yaml
title: model 2
specimen: {porosity: 20 %}
levels: [5 MPa]
contact_law: {model: model_2, friction: 0.5}
postprocessor: [{type: stress}]
expected: {peaks: {second: 3, third: ~}}
)");
  const Json same = read(R"(title: model 2
seed: 7
specimen: {diameter: 23 mm, slenderness: 2, porosity: 20 %}
levels: [5 MPa]
contact_law: {type: brittle, bond_modulus: 10 GPa, tensile_strength: 40 MPa, friction: 0.5, model: model_2}
postprocessor: [{type: stress}]
expected: {source: a paper, peaks: {first: 1, second: 3, third: ~}}
quick: 1
)");
  EXPECT_EQ(got.dump(), same.dump());
}

TEST_F(Bases, WhatIsWrittenOfTheMergedWorkflowNeedsNoBase) {
  write("base.yaml", specimen);
  const Json config = read("base: base.yaml\nspecimen: {porosity: 20 %}\n");
  const std::string text = write_yaml(config, fake::root(), fake::Plugins());
  fs::remove(folder_ / "base.yaml");
  EXPECT_EQ(read(text).dump(), config.dump()) << text;
}

TEST_F(Bases, AnotherPluginBeginsItsSectionAnew) {
  write("base.yaml", specimen);
  EXPECT_EQ(read("base: base.yaml\ncontact_law: {type: soft, stiffness: 1 N/m}\n")["contact_law"],
            Json::parse(R"({"type": "soft", "stiffness": 1.0})"));
  EXPECT_EQ(read("base: base.yaml\ncontact_law: {type: brittle, friction: 1}\n")["contact_law"]["bond_modulus"], 1e10);
}

TEST_F(Bases, AlternativesOfTheBaseGiveWay) {
  write("base.yaml", specimen);
  const Json got = read("base: base.yaml\nspecimen: {height: 1 m}\nslow: 2\n");
  EXPECT_EQ(got["specimen"], Json::parse(R"({"diameter": 0.023, "height": 1.0, "porosity": 0.23})"));
  EXPECT_FALSE(got.contains("quick"));
  EXPECT_EQ(problems_of("base: base.yaml\nquick: 1\nslow: 2\n"),
            "workflow.yaml:3:1: give only one of `quick` and `slow`, not `quick` and `slow`");
}

TEST_F(Bases, AlternativesOfTheFilesGiveWayToOverrides) {
  write("base.yaml", specimen);
  const Json got = read("base: base.yaml\n", {"specimen.height=1 m", "slow=2"});
  EXPECT_EQ(got["specimen"], Json::parse(R"({"diameter": 0.023, "height": 1.0, "porosity": 0.23})"));
  EXPECT_FALSE(got.contains("quick"));
  EXPECT_EQ(problems_of("base: base.yaml\n", {"quick=1", "slow=2"}),
            "--set:2:1: give only one of `quick` and `slow`, not `quick` and `slow`")
      << "of two overrides neither gives way";
  EXPECT_EQ(problems_of("base: base.yaml\nquick: 1\nslow: 2\n", {"seed=3"}),
            "workflow.yaml:3:1: give only one of `quick` and `slow`, not `quick` and `slow`");
}

TEST_F(Bases, BaseOfABaseAndIncompleteBases) {
  write("shared/law.yaml", "contact_law: {type: brittle, bond_modulus: 1 GPa, tensile_strength: 1 MPa}\nseed: 1\n");
  write("shared/specimen.yaml", "base: law.yaml\nspecimen: {diameter: 1 m}\nseed: 2\nsteps: 2\n");
  const Json got = read("base: shared/specimen.yaml\nspecimen: {height: 2 m}\nsteps: 3\n");
  EXPECT_EQ(got["contact_law"]["bond_modulus"], 1e9);
  EXPECT_EQ(got["specimen"], Json::parse(R"({"diameter": 1.0, "height": 2.0})"));
  EXPECT_EQ(got["seed"], 2);
  EXPECT_EQ(got["steps"], 3);
  EXPECT_FALSE(got.contains("base"));
}

TEST_F(Bases, RelativePathsStartAtTheFileTheyAreWrittenIn) {
  write("shared/base.yaml", std::string(specimen) + "particles: spheres.csv\n");
  const auto path = [&](const char* name) { return (folder_ / name).string(); };
  EXPECT_EQ(read("base: shared/base.yaml\n")["particles"], path("shared/spheres.csv"));
  EXPECT_EQ(read("base: shared/base.yaml\nparticles: mine.csv\n")["particles"], path("mine.csv"));
  EXPECT_EQ(read("base: shared/base.yaml\n", {"particles=given.csv"})["particles"], path("given.csv"));
  write("shared/base.yaml", specimen);
  EXPECT_EQ(read("base: shared/base.yaml\n")["particles"], path("particles.csv")) << "the default is the workflow's";
}

TEST_F(Bases, OverridesComeLast) {
  write("base.yaml", specimen);
  const Json got = read("base: base.yaml\ncontact_law: {friction: 0.5}\n",
                        {"contact_law.friction=0.75", "postprocessor.1.every=5 ms", "specimen.porosity=10 %"});
  EXPECT_EQ(got["contact_law"]["friction"], 0.75);
  EXPECT_EQ(got["postprocessor"][1]["every"], 0.005);
  EXPECT_EQ(got["specimen"]["porosity"], 0.1);
  EXPECT_EQ(problems_of("base: base.yaml\n", {"base=other.yaml"}),
            "--set:1:1: base: cannot be set here; only a workflow file names the file it builds on");
}

TEST_F(Bases, AnchorsEndWithTheirFile) {
  write("base.yaml", std::string(specimen) + "steps: &n 5\n");
  EXPECT_NE(problems_of("base: base.yaml\nseed: *n\n").find("workflow.yaml:2:7: "), std::string::npos);
}

TEST_F(Bases, CountOfFilesIsBounded) {
  write("1.yaml", specimen);
  for (int k = 2; k <= 17; ++k) write(std::to_string(k) + ".yaml", "base: " + std::to_string(k - 1) + ".yaml\n");
  EXPECT_EQ(read("base: 16.yaml\n")["seed"], 7);
  EXPECT_EQ(problems_of("base: 17.yaml\n"), "2.yaml:1:7: base: more than 16 files build on each other");
}

// The names differ in every round of the loop; what counts is the file.
TEST_F(Bases, LoopsUnderOtherNamesAreFound) {
  write("a.yaml", "base: shared/../shared/b.yaml\n");
  fs::create_symlink(folder_ / "a.yaml", folder_ / "shared/c.yaml");
  write("shared/b.yaml", "base: c.yaml\n");
  EXPECT_EQ(problems_of("base: a.yaml\n"),
            "shared/b.yaml:1:7: base: the files build on each other in a circle: a.yaml -> shared/b.yaml -> a.yaml");
}

TEST_F(Bases, ManyLayersKeepTheirPlaces) {
  write("1.yaml", "specimen:\n  diameter: wide\n  height: 1 m\n");
  write("2.yaml", "base: 1.yaml\n\n\nseed: -1\n");
  try {
    read("base: 2.yaml\ncontact_law: {type: soft, stiffness: 1}\n", {"steps=0"});
    FAIL();
  } catch (const ConfigError& error) {
    std::vector<std::string> places;
    for (const Problem& p : error.problems())
      places.push_back(fs::path(p.file).filename().string() + ":" + std::to_string(p.line) + ":" +
                       std::to_string(p.column) + " " + p.path);
    EXPECT_EQ(places, (std::vector<std::string>{"workflow.yaml:2:38 contact_law.stiffness", "2.yaml:4:7 seed",
                                                "1.yaml:2:13 specimen.diameter", "--set:1:7 steps"}));
  }
}

}  // namespace
}  // namespace breccia
