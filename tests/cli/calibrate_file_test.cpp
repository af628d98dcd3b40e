// SPDX-License-Identifier: BSD-3-Clause
// The files of calibrations: what is wrong with one is said before anything is run.
#include "calibrate_support.hpp"

namespace breccia::testing {
namespace {

TEST_F(Calibrate, MistakesHaveOneLineEach) {
  const std::string good = file(20e9, 50e6, small_budget);
  const auto refused = [&](const std::string& what, const std::string& with, const std::string& expected) {
    std::string text = good;
    ASSERT_NE(text.find(what), text.npos) << what;
    text.replace(text.find(what), what.size(), with);
    write("c.yaml", text);
    for (const char* verb : {"validate", "calibrate"}) {
      const Result r = call(std::string(verb) + " c.yaml");
      EXPECT_EQ(r.code, 2) << r.text;
      EXPECT_EQ(r.text, "c.yaml" + expected + "\n");
    }
    EXPECT_FALSE(fs::exists(folder_ / "results"));
  };
  refused("value: 5e+07 Pa", "value: 50",
          ":4:37: targets.ucs.value: `50` is a plain number, and `peak_stress_Pa` is in Pa");
  refused("value: 5e+07 Pa", "value: 50 kN",
          ":4:37: targets.ucs.value: `50 kN` is a force, and `peak_stress_Pa` is in Pa");
  refused("value: 5e+07 Pa", "value: 50 MPas", ":4:37: targets.ucs.value: `MPas` is not a known unit");
  refused("scatter: 5 %", "scatter: 0 %", ":4:56: targets.ucs.scatter: the scatter must be above 0");
  refused("scatter: 5 %", "scatter: 5 GPa, weight: 2",
          ":4:63: targets.ucs: give only one of `scatter` and `weight`, not `scatter` and `weight`");
  refused("file: rock.yaml", "file: rok.yaml", ":1:26: workflows.test.file: cannot read rok.yaml: no such file");
  refused("to: 60 GPa", "to: 60 MPa",
          ":6:62: parameters.modulus.to: must be in the unit of `from`, `4 GPa`, not `60 MPa`");
  refused("from: 4 GPa", "from: 0 GPa", ":6:51: parameters.modulus.from: must be above 0 on a log scale, not `0 GPa`");
  refused("from: 4 GPa, to: 60 GPa", "from: 4 mm, to: 60 mm",
          ":6:51: contact_law.bond_modulus: `mm` is a length; a pressure such as Pa, MPa, GPa or psi is needed");
  refused("contact_law.bond_modulus", "contact_law.bond_modulos",
          ":6:31: contact_law.bond_modulos: is not a known parameter; did you mean `bond_modulus`?");
  refused(
      "contact_law.bond_modulus", "contact_law.tensile_strength.mean",
      ":7:21: parameters.strength: `contact_law.tensile_strength.mean` gets its value from the parameter `modulus` as "
      "well");
  refused("contact_law.bond_modulus", "seed",
          ":6:19: parameters.modulus: the seed is not sought: it tells the packings apart");
  refused("targets:", "targts:", ":2:1: targts: is not a known parameter; did you mean `targets`?");
  refused(
      "runs: 12", "runs: 6",
      ":8:9: budget: 6 runs are too few for 2 parameters in 1 workflow: at least 8 are needed (3 at the start, 1 for "
      "the check, 1 for each point between)");
}

TEST_F(Calibrate, AKeyThatNoSummaryHasEndsItAtOnce) {
  NEEDS_SEARCH();
  std::string text = file(20e9, 50e6, small_budget);
  text.replace(text.find("peak_stress_Pa"), 14, "peak_stres_Pa");
  write("c.yaml", text);
  const Result r = call("calibrate c.yaml --output out --jobs 2");
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_TRUE(has(r.text,
                  "targets.ucs.key: no summary of the workflow `test` has the number `peak_stres_Pa`; did you "
                  "mean `peak_stress_Pa`?"))
      << r.text;
}

TEST_F(Calibrate, TheSchemaInTheDocsIsThatOfTheProgram) {
  NEEDS_SEARCH();
  EXPECT_TRUE(call("schema calibration").text == content(BRECCIA_SOURCE_DIR "/docs/calibration.schema.json"))
      << "renew it: breccia schema calibration > docs/calibration.schema.json";
}

/// Of an installation without OpenTURNS: this one, less the search.
TEST_F(Calibrate, WithoutASearchFilesAreCheckedAndRunsRefused) {
  fs::create_directories(folder_ / "installed/bin");
  fs::create_directories(folder_ / "installed/lib/breccia");
  fs::copy_file(program, folder_ / "installed/bin/breccia");  // it looks for its plugins beside itself
  fs::create_symlink(BRECCIA_BINARY_DIR "/lib/breccia-core", folder_ / "installed/lib/breccia-core");
  for (const auto& entry : fs::directory_iterator(BRECCIA_BINARY_DIR "/lib/breccia"))
    if (entry.path().filename() != search_file())
      fs::create_symlink(entry.path(), folder_ / "installed/lib/breccia" / entry.path().filename());
  const auto without = [&](const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.string() + "' && installed/bin/breccia " + arguments + " >said.txt 2>&1 </dev/null";
    const int status = std::system(command.c_str());
    return Result{WIFEXITED(status) ? WEXITSTATUS(status) : 128, content(folder_ / "said.txt")};
  };
  const std::string good = file(20e9, 50e6, small_budget);
  write("c.yaml", good);
  const Result valid = without("validate c.yaml");
  EXPECT_EQ(valid.code, 0);
  EXPECT_EQ(valid.text,
            "c.yaml: ok, a calibration of at most 12 runs; to run it needs a search, which is not installed here\n");
  const std::string what =
      "the search `kriging` is not installed, since this Breccia was built without OpenTURNS. Install OpenTURNS "
      "(Debian's libopenturns-dev) and build Breccia again with -DBRECCIA_OPENTURNS=ON, or name a search of your own "
      "under `search` (`breccia new search NAME` begins one)\n";
  for (const char* arguments : {"calibrate c.yaml", "calibrate c.yaml --cases", "calibrate c.yaml --case 1"}) {
    const Result refused = without(arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_EQ(refused.text, "c.yaml: nothing proposes the points: " + what);
  }
  EXPECT_FALSE(fs::exists(folder_ / "results"));
  write("c.yaml", good + "search: {type: kriging, design: 9}\n");
  const Result named = without("validate c.yaml");
  EXPECT_EQ(named.code, 2);
  EXPECT_EQ(named.text, "c.yaml:9:16: search.type: " + what);
  std::string wrong = good;
  wrong.replace(wrong.find("from: 4 GPa"), 11, "from: 0 GPa");
  write("c.yaml", wrong);
  EXPECT_EQ(without("validate c.yaml").text,
            "c.yaml:6:51: parameters.modulus.from: must be above 0 on a log scale, not `0 GPa`\n");
  EXPECT_TRUE(has(without("list").text, "protocol"));
  EXPECT_FALSE(has(without("list").text, "kriging"));
}

TEST_F(Calibrate, IsNoWorkflow) {
  write("c.yaml", file(20e9, 50e6, small_budget));
  const Result run = call("run c.yaml");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.text, "c.yaml: this is a calibration, not a workflow: `breccia calibrate c.yaml` runs it\n");
  EXPECT_TRUE(call("validate c.yaml").text.starts_with("c.yaml: ok, a calibration of at most 12 runs"));
  const Result workflow = call("calibrate rock.yaml");
  EXPECT_EQ(workflow.code, 2);
  EXPECT_EQ(workflow.text, "rock.yaml: this is a workflow, not a calibration: `breccia run rock.yaml` runs it\n");
}

}  // namespace
}  // namespace breccia::testing
