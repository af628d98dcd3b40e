// SPDX-License-Identifier: BSD-3-Clause
// The program as a user meets it: exit codes, messages, files.
#include <algorithm>
#include <csignal>
#include <cstring>
#include <thread>

#include "small_specimen.hpp"

namespace breccia::testing {
namespace {

using Cli = SmallSpecimen;

TEST_F(Cli, RunMakesEveryFileAndTheSummaryHasItsKeys) {
  write_small();
  const Result r = call("run small.yaml --output out");
  ASSERT_EQ(r.code, 0) << r.text;
  for (const char* file : {"summary.json", "curves.csv", "resolved.yaml", "run.log"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  for (const auto& entry : fs::directory_iterator(folder_ / "out"))
    EXPECT_NE(entry.path().extension(), ".partial") << entry.path();
  const Json s = summary("out");
  for (const char* key : {"workflow",
                          "seed",
                          "threads",
                          "steps",
                          "time_step_s",
                          "wall_time_s",
                          "particles",
                          "bonds",
                          "porosity",
                          "coordination_number",
                          "youngs_modulus_Pa",
                          "poisson_ratio",
                          "peak_stress_Pa",
                          "peak_strain",
                          "bonds_broken_tension",
                          "bonds_broken_shear",
                          "global_damage",
                          "fabric_diagonal",
                          "ns_per_bond_step",
                          "energy_error",
                          "reference"})
    EXPECT_TRUE(s.contains(key)) << key;
  EXPECT_EQ(s["format"], 1);
  EXPECT_EQ(s["values"]["peak_stress"], (Json{{"value", s["peak_stress_Pa"]}, {"unit", "Pa"}}));
  EXPECT_EQ(s["values"]["poisson_ratio"], (Json{{"value", s["poisson_ratio"]}, {"unit", "1"}}));
  EXPECT_EQ(s["values"]["energy.elastic"], (Json{{"value", s["energy"]["elastic_J"]}, {"unit", "J"}}));
  EXPECT_EQ(s["workflow"], "small");
  EXPECT_EQ(s["particles"], 128);
  EXPECT_GT(s["youngs_modulus_Pa"].get<double>(), 1e9);
  EXPECT_LT(std::abs(s["energy_error"].get<double>()), 0.02);
}

TEST_F(Cli, ResolvedWorkflowAndOtherThreadsGiveTheSameBits) {
  write_small();
  ASSERT_EQ(call("run small.yaml --output a --threads 1").code, 0);
  ASSERT_EQ(call("run a/resolved.yaml --output b --threads 2").code, 0);
  EXPECT_EQ(content(folder_ / "a/curves.csv"), content(folder_ / "b/curves.csv"));
  EXPECT_EQ(content(folder_ / "a/resolved.yaml"), content(folder_ / "b/resolved.yaml"));
}

TEST_F(Cli, ResultsAreNeverSilentlyOverwritten) {
  write_small();
  ASSERT_EQ(call("run small.yaml --output out").code, 0);
  const std::string before = content(folder_ / "out/summary.json");
  const Result again = call("run small.yaml --output out");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.text.find("--overwrite"), std::string::npos) << again.text;
  EXPECT_EQ(content(folder_ / "out/summary.json"), before);
  EXPECT_EQ(call("run small.yaml --output out --overwrite").code, 0);
  // A run that fails leaves the earlier results where they were.
  const std::string kept = content(folder_ / "out/summary.json");
  write("bad.csv", "x,y,z,radius\n0,0,0,-1\n");
  EXPECT_EQ(call("run small.yaml --output out --overwrite --set packing.file=bad.csv").code, 2);
  EXPECT_EQ(content(folder_ / "out/summary.json"), kept);
  EXPECT_FALSE(fs::exists(folder_ / "out.previous"));
  fs::create_directories(folder_ / "mine");
  write("mine/thesis.txt", "dear");
  EXPECT_EQ(call("run small.yaml --output mine --overwrite").code, 2) << "not a result folder";
  EXPECT_EQ(content(folder_ / "mine/thesis.txt"), "dear");
}

bool warned(const Json& summary, const std::string& of) {
  const Json all = summary.at("warnings");
  return std::any_of(all.begin(), all.end(),
                     [&](const Json& w) { return w.get<std::string>().find(of) != std::string::npos; });
}

TEST_F(Cli, WarnsOfAPackingThatIsAlmostSurelyWrong) {
  write_small();
  const auto lattice = [](int radius) {
    std::ostringstream csv;
    csv << "x,y,z,radius\n";
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) csv << 2 * i + 1 << ',' << 2 * j + 1 << ',' << 2 * k + 1 << ',' << radius << '\n';
    return csv.str();
  };
  write("small.csv", lattice(1));
  const Result fine = call("run small.yaml --output fine");
  ASSERT_EQ(fine.code, 0) << fine.text;
  EXPECT_EQ(summary("fine")["warnings"], Json::array()) << "none where nothing is wrong";

  write("small.csv", lattice(2));
  const Result diameters = call("run small.yaml --output diameters --set protocol.max_strain=0.0001");
  ASSERT_EQ(diameters.code, 0) << diameters.text;
  EXPECT_TRUE(warned(summary("diameters"), "porosity")) << diameters.text;
  EXPECT_TRUE(warned(summary("diameters"), "overlap")) << diameters.text;
  EXPECT_NE(diameters.text.find("warning: "), std::string::npos);

  // One alone, and two that are bonded to each other.
  write("small.csv", lattice(1) + "200,1,1,1\n");
  EXPECT_NE(call("run small.yaml --output one").text.find("particle 128 of the packing"), std::string::npos);
  write("small.csv", lattice(1) + "200,1,1,1\n202,1,1,1\n");
  EXPECT_NE(call("run small.yaml --output two").text.find("particle 129 of the packing"), std::string::npos);
}

TEST_F(Cli, ShowsTheResultsAfterARun) {
  write_small();
  const Result r = call("run small.yaml --output out");
  for (const char* text :
       {"Young's modulus (GPa)", "peak stress (MPa)", "bonds broken in tension", "energy unaccounted for (%)"})
    EXPECT_NE(r.text.find(text), std::string::npos) << text << " in " << r.text;
  EXPECT_EQ(r.text.find("paper"), std::string::npos) << "there is no reference";
}

TEST_F(Cli, AllErrorsOfAWorkflowInOnePassWithPlaces) {
  write_small();
  write("bad.yaml", std::string(small) + "samplng: {every_steps: 3}\nseed: -1\n");
  const Result r = call("validate bad.yaml");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("bad.yaml:9:1: samplng"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("did you mean `sampling`"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("bad.yaml:10:"), std::string::npos) << r.text;
  EXPECT_EQ(call("run bad.yaml --output out").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "bad input must leave nothing behind";
}

TEST_F(Cli, WrongUnitWrongPluginMissingFile) {
  write_small();
  Result r = call("run small.yaml --output out --set contact_law.bond_modulus='10 mm'");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("contact_law.bond_modulus"), std::string::npos) << r.text;
  r = call("run small.yaml --output out --set contact_law.type=elastic_britle");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("elastic_brittle"), std::string::npos) << r.text;
  r = call("run nowhere.yaml");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("nowhere.yaml"), std::string::npos) << r.text;
  write("nan.csv", "x,y,z,radius\n0,0,0,1\n0,0,nan,1\n");
  r = call("run small.yaml --output out --set packing.file=nan.csv");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("nan.csv"), std::string::npos) << r.text;
  write("empty.csv", "x,y,z,radius\n");
  EXPECT_EQ(call("run small.yaml --output out2 --set packing.file=empty.csv").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out2")) << "bad input must leave nothing behind";
  EXPECT_EQ(call("validate small.yaml --set packing.file=missing.csv").code, 2) << "what run refuses, validate refuses";
}

TEST_F(Cli, OverridesReachTheRun) {
  write_small();
  ASSERT_EQ(call("run small.yaml --output out --set seed=7 --set bonding.tolerance=0.2").code, 0);
  EXPECT_EQ(summary("out")["seed"], 7);
  EXPECT_NE(content(folder_ / "out/resolved.yaml").find("tolerance: 0.2"), std::string::npos);
}

TEST_F(Cli, CtrlCStopsWithFilesComplete) {
  write_small();
  const pid_t child = fork();
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stderr) || chdir(folder_.c_str()) != 0) _exit(99);
    execl(program.c_str(), program.c_str(), "run", "small.yaml", "--output", "out", "--set",
          "protocol.platen_velocity=0.00005 m/s", nullptr);
    _exit(98);
  }
  for (int k = 0; k < 600 && !fs::exists(folder_ / "out/curves.csv.partial"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(summary("out")["interrupted"], true);
  EXPECT_TRUE(fs::exists(folder_ / "out/curves.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/curves.csv.partial"));
}

TEST_F(Cli, CtrlCStopsACheckWhichLeavesNothing) {
  const fs::path temporary = folder_ / "temporary";
  fs::create_directory(temporary);
  const pid_t child = fork();
  if (child == 0) {
    setenv("TMPDIR", temporary.c_str(), 1);
    if (!std::freopen((folder_ / "said").c_str(), "w", stdout) || dup2(fileno(stdout), STDERR_FILENO) < 0) _exit(99);
    execl(program.c_str(), program.c_str(), "check", "packing/labra_onate", nullptr);
    _exit(98);
  }
  for (int k = 0; k < 6000 && fs::is_empty(temporary); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  const std::string said = content(folder_ / "said");
  ASSERT_TRUE(WIFEXITED(status)) << said;
  EXPECT_EQ(WEXITSTATUS(status), 130) << said;
  EXPECT_NE(said.find("breccia: stopped on request"), std::string::npos) << said;
  EXPECT_TRUE(fs::is_empty(temporary));
}

TEST_F(Cli, FullDiskIsToldAndNothingLooksWhole) {
  write_small();
  // A file size limit stands for the full disk: writes fail half-way in the same manner.
  const Result r = call("run small.yaml --output out --set sampling.every_steps=1", "ulimit -f 8; trap '' XFSZ;");
  EXPECT_NE(r.code, 0);
  EXPECT_NE(r.text.find("cannot write"), std::string::npos) << r.text;
  EXPECT_FALSE(fs::exists(folder_ / "out/curves.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/summary.json"));
}

TEST_F(Cli, ListDescribeSchema) {
  Result r = call("list");
  EXPECT_EQ(r.code, 0) << r.text;
  for (const char* name : {"packing/labra_onate", "packing/from_file", "contact_law/elastic_brittle",
                           "protocol/uniaxial_compression", "postprocessor/stress"})
    EXPECT_NE(r.text.find(name), std::string::npos) << name;
  r = call("list contact_laws");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("contact_law"), std::string::npos);
  r = call("describe contact_law/elastic_brittle");
  EXPECT_EQ(r.code, 0);
  for (const char* word : {"bond_modulus", "Pa", "model_3c", "Eq. 19"})
    EXPECT_NE(r.text.find(word), std::string::npos) << word;
  EXPECT_EQ(Json::parse(call("describe contact_law/elastic_brittle --format json").text)["name"], "elastic_brittle");
  EXPECT_NE(call("describe workflow --format markdown").text.find("bonding"), std::string::npos);
  EXPECT_EQ(call("describe contact_law/elastic_britle").code, 2);
  EXPECT_TRUE(Json::parse(call("schema").text).contains("$schema"));
}

TEST_F(Cli, AMisspeltWordOfTheCommandLineIsNamed) {
  Result r = call("vlidate x.yaml");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("unknown verb `vlidate`; did you mean `validate`?"), std::string::npos) << r.text;
  r = call("frobnicate");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("unknown verb `frobnicate`; there are `run`"), std::string::npos) << r.text;
  r = call("run x.yaml --outptu=out");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("unknown option `--outptu`; did you mean `--output`?"), std::string::npos) << r.text;
}

TEST_F(Cli, WhatElseIsWrongWithACommandIsOneLine) {
  write_small();
  EXPECT_EQ(call("run small.yaml --variant a --variant b").text,
            "breccia run: --variant: may be given only once (`breccia run --help`)\n");
  const Result r = call("run small.yaml --output");
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.text, "breccia run: --output: 1 required FOLDER missing (`breccia run --help`)\n");
}

TEST_F(Cli, DescribeTakesANameAKindAndSuggests) {
  EXPECT_EQ(call("describe elastic_brittle").text, call("describe contact_law/elastic_brittle").text);
  Result r = call("describe protocol");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(r.text.find("protocol/uniaxial_compression: "), std::string::npos) << r.text;
  r = call("describe elastic_britle");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("did you mean `elastic_brittle`?"), std::string::npos) << r.text;
  // The licence of another author's plugin is not ours to tell.
  EXPECT_NE(call("describe elastic_brittle").text.find("licence: BSD-3-Clause"), std::string::npos);
  fs::create_directories(folder_ / "own");
  const std::string so = "breccia_contact_law.elastic_brittle.so";
  fs::copy(fs::path(program).parent_path().parent_path() / "lib/breccia" / so, folder_ / "own" / so);
  r = call("describe elastic_brittle", "BRECCIA_PLUGIN_PATH=own");
  EXPECT_EQ(r.text.find("licence"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("own/" + so), std::string::npos) << r.text;
}

TEST_F(Cli, PluginsOfTheCommandLineAreLoaded) {
  write_small();
  write("empty", "");
  for (const char* given : {"[empty]", "[{path: empty}]"}) {
    const std::string set = std::string(" --set 'plugins=") + given + "'";
    for (const char* verb : {"validate small.yaml", "run small.yaml --output out"}) {
      const Result r = call(verb + set);
      EXPECT_EQ(r.code, 2) << verb << set;
      EXPECT_NE(r.text.find("empty"), std::string::npos) << r.text;
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  write("variant.yaml", "base: small.yaml\nvariants: {own: {plugins: [empty]}}\n");
  EXPECT_EQ(call("run variant.yaml --variant own --output out").code, 2);
  EXPECT_EQ(call("validate variant.yaml --variant own").code, 2);
  write("study.yaml", "workflow: small.yaml\ngrid: {plugins: [[empty]]}\n");
  EXPECT_EQ(call("validate study.yaml").code, 2);
  EXPECT_EQ(call("validate small.yaml").code, 0);
}

TEST_F(Cli, TwoOfAKindAreRefusedBeforeTheRun) {
  write_small();
  for (const char* list : {"postprocessors=[{type: stress}, {type: stress}]", "outputs=[{type: vtk}, {type: vtk}]",
                           "renderers=[{type: pictures}, {type: pictures}]"}) {
    const Result r = call(std::string("validate small.yaml --set '") + list + "'");
    EXPECT_EQ(r.code, 2) << list;
  }
}

TEST_F(Cli, ValidateTakesAVariant) {
  write_small();
  write("v.yaml", "base: small.yaml\nvariants: {good: {seed: 2}, bad: {seed: -1}}\n");
  EXPECT_EQ(call("validate v.yaml").code, 2);
  EXPECT_EQ(call("validate v.yaml --variant good").code, 0);
  EXPECT_EQ(call("validate v.yaml --variant bad").code, 2);
  const Result r = call("validate v.yaml --variant goood");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("did you mean `good`?"), std::string::npos) << r.text;
}

TEST_F(Cli, AStudyOfVariantsVariesThem) {
  write_small();
  write("v.yaml", "base: small.yaml\nvariants: {two: {seed: 2}, three: {seed: 3}}\n");
  write("names.yaml", "workflow: v.yaml\ngrid: {variants: [two, three]}\n");
  Result r = call("sweep names.yaml --cases");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(r.text.find("2,variants=three,three,"), std::string::npos) << r.text;
  write("own.yaml", "workflow: small.yaml\ngrid: {variants: [{a: {seed: 2}}, {b: {seed: 3}}]}\n");
  r = call("validate own.yaml");
  EXPECT_NE(r.text.find("ok, a study of 2 cases"), std::string::npos) << r.text;
  write("unknown.yaml", "workflow: v.yaml\ngrid: {variants: [two, thre]}\n");
  r = call("validate unknown.yaml");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("did you mean `three`?"), std::string::npos) << r.text;
}

TEST_F(Cli, ShippedWorkflowsAreValidAndTheSchemaIsCurrent) {
  std::string files;
  for (const auto& entry : fs::recursive_directory_iterator(BRECCIA_SOURCE_DIR "/workflows"))
    if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() != "base")
      files += " '" + entry.path().string() + "'";
  ASSERT_FALSE(files.empty());
  const Result r = call("validate" + files);
  EXPECT_EQ(r.code, 0) << r.text;
  const std::string study = BRECCIA_SOURCE_DIR "/workflows/ouyang2017/study_w.yaml";
  EXPECT_NE(r.text.find("study_w.yaml: ok, a study of 30 cases"), std::string::npos) << r.text;
  const Result not_run = call("run '" + study + "'");
  EXPECT_EQ(not_run.code, 2);
  EXPECT_NE(not_run.text.find("is a study, not a workflow: `breccia sweep"), std::string::npos) << not_run.text;
  EXPECT_TRUE(call("schema").text == content(BRECCIA_SOURCE_DIR "/docs/workflow.schema.json"))
      << "renew it: breccia schema > docs/workflow.schema.json";
}

}  // namespace
}  // namespace breccia::testing
