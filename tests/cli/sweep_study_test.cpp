// SPDX-License-Identifier: BSD-3-Clause
// What a study says, and what is said of a study that is not in order. Nothing is run here.
#include <cmath>

#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

class SweepStudy : public SweepProgram {
 protected:
  Rows cases(const std::string& study) const {
    write("study.yaml", study);
    const Result r = call("sweep study.yaml --cases");
    EXPECT_EQ(r.code, 0) << r.text;
    return r.code == 0 ? rows_of(r.text) : Rows();
  }
  void expect_refused(const std::string& study, const std::string& text) const {
    write("study.yaml", study);
    for (const char* how : {"", " --cases", " --collect"}) {
      const Result r = call(std::string("sweep study.yaml") + how);
      EXPECT_EQ(r.code, 2);
      EXPECT_EQ(r.text, text);
    }
    EXPECT_FALSE(fs::exists(folder_ / "results")) << "bad input must leave nothing behind";
  }
};

TEST_F(SweepStudy, GridIsAllCombinationsTheLastParameterFastest) {
  const Rows rows =
      cases("workflow: small.yaml\ngrid: {contact_law.bond_modulus: [10 GPa, 5000 MPa], seed: [1, 2, 3]}\n");
  ASSERT_EQ(rows.size(), 6u);
  std::string order;
  for (const auto& row : rows)
    order += row.at("case") + ":" + row.at("contact_law.bond_modulus_Pa") + "/" + row.at("seed") + " ";
  EXPECT_EQ(
      order,
      "1:10000000000.0/1 2:10000000000.0/2 3:10000000000.0/3 4:5000000000.0/1 5:5000000000.0/2 6:5000000000.0/3 ");
  EXPECT_EQ(rows[3].at("folder"), "bond_modulus=5000_MPa_seed=1");
  EXPECT_FALSE(fs::exists(folder_ / "results")) << "a listing writes nothing";
}

TEST_F(SweepStudy, ListIsRowByRowAndCombinesWithAGridAndWorkflows) {
  const Rows rows = cases(
      "workflows: [{name: a, file: small.yaml}, {name: b, file: weak.yaml}]\nlist: {seed: [1, 2], "
      "contact_law.friction: [0.1, "
      "0.2]}\n"
      "grid: {contact_law.model: [model_1, model_2]}\n");
  ASSERT_EQ(rows.size(), 8u);
  std::string order;
  for (const auto& row : rows)
    order += row.at("seed") + row.at("contact_law.friction") + row.at("contact_law.model") + row.at("workflow") + " ";
  EXPECT_EQ(order,
            "10.1model_1a 10.1model_1b 10.1model_2a 10.1model_2b 20.2model_1a 20.2model_1b 20.2model_2a 20.2model_2b ");
}

TEST_F(SweepStudy, WholeSectionsAndListItemsCanVary) {
  const Rows rows = cases(
      "workflow: small.yaml\ngrid:\n  bonding: [{tolerance: 0.1}, {coordination_number: 4}]\n  postprocessors.3.type: "
      "[damage]\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NE(rows[0].at("inputs_sha256"), rows[1].at("inputs_sha256"));
}

TEST_F(SweepStudy, LatinHypercubeHasOneSampleInEachStratum) {
  const std::string study =
      "workflow: small.yaml\nlatin_hypercube:\n  samples: 40\n  seed: SEED\n  ranges:\n"
      "    - {parameter: contact_law.friction, from: 0.1, to: 0.9}\n"
      "    - {parameter: contact_law.bond_modulus, from: 1 GPa, to: 100 GPa, scale: log}\n";
  const auto with_seed = [&](const std::string& seed) {
    std::string text = study;
    return cases(text.replace(text.find("SEED"), 4, seed));
  };
  const Rows rows = with_seed("1");
  ASSERT_EQ(rows.size(), 40u);
  std::set<int> linear, log;
  double together = 0;
  for (const auto& row : rows) {
    const double f = (std::stod(row.at("contact_law.friction")) - 0.1) / 0.8,
                 m = std::log10(std::stod(row.at("contact_law.bond_modulus_Pa")) / 1e9) / 2;
    linear.insert(int(std::floor(40 * f)));
    log.insert(int(std::floor(40 * m)));
    together += (f - 0.5) * (m - 0.5) * 12 / 40;
  }
  EXPECT_EQ(linear.size(), 40u);
  EXPECT_EQ(log.size(), 40u);
  EXPECT_EQ(*linear.begin(), 0);
  EXPECT_EQ(*log.rbegin(), 39);
  EXPECT_LT(std::abs(together), 0.5) << "the two follow each other";
  EXPECT_EQ(rows, with_seed("1"));
  EXPECT_NE(rows, with_seed("2"));
}

TEST_F(SweepStudy, MistakesOfTheStudyAreToldTogether) {
  expect_refused("workflow: small.yaml\ngrids: {seed: [1]}\n",
                 "study.yaml:2:1: grids: is not a known parameter; did you mean `grid`?\n");
  expect_refused("workflow: small.yaml\n",
                 "study.yaml:1:1: there is nothing to vary; one of `grid`, `list` and `latin_hypercube` is needed\n");
  expect_refused("workflow: small.yaml\ngrid: {seed: [1]}\ncollect: porosity\n",
                 "study.yaml:3:10: collect: must be a list (`[..., ...]`) of texts, not the value `porosity`\n");
  expect_refused("grid: {seed: [1]}\n", "study.yaml:1:1: one of `workflow` and `workflows` must be given\n");
  expect_refused("workflow: small.yaml\nfixed: {seed: 4}\ngrid: {seed: [1, 2]}\n",
                 "study.yaml:2:9: fixed.seed: also varies; it is either fixed or not\n");
  expect_refused(
      "base: small.yaml\nworkflow: small.yaml\ngrid: {seed: [1, 2]}\n",
      "study.yaml:1:1: base: cannot be set here; only a workflow file names the file it builds on\n"
      "study.yaml:1:1: base: is not a known parameter; known here: `name`, `description`, `workflow`, `workflows`, "
      "`fixed`, `grid`, "
      "`list`, `latin_hypercube`, `collect`, `derived`, `charts`, `renderer`\n");
  expect_refused("workflow: nowhere.yaml\ngrid: {seed: [1]}\n",
                 "study.yaml:1:11: workflow: cannot read nowhere.yaml: no such file\n");
  expect_refused(
      "workflow: small.yaml\ngrid: {seed: 3, dimension: [], thickness: [1 m, 1 m]}\nlist: {a: [1, 2], b: [1], seed: "
      "[1, 2]}\n",
      "study.yaml:2:8: grid.seed: `seed` gets its values from another place of the study as well\n"
      "study.yaml:2:14: grid.seed: must be a list of values, such as `[0.2, 0.4]`, not the value `3`\n"
      "study.yaml:2:28: grid.dimension: has no values\n"
      "study.yaml:2:49: grid.thickness: the value `1 m` is given twice\n"
      "study.yaml:3:22: list.b: has 1 values where `a` has 2: case by case, every parameter of a list needs one\n");
  expect_refused(
      "workflow: small.yaml\nlatin_hypercube:\n  samples: 3\n  ranges:\n    - {parameter: a, from: 1 GPa, to: 2 MPa}\n"
      "    - {parameter: b, from: 0, to: 1, scale: log}\n    - {parameter: c, from: 3, to: 2}\n    - {parameter: d, "
      "from: x, to: "
      "2}\n",
      "study.yaml:5:39: latin_hypercube.ranges[0].to: must be in the unit of `from`, `1 GPa`, not `2 MPa`\n"
      "study.yaml:6:28: latin_hypercube.ranges[1].from: must be above 0 on a log scale, not `0`\n"
      "study.yaml:7:35: latin_hypercube.ranges[2].to: must be above `from`, `3`, not `2`\n"
      "study.yaml:8:28: latin_hypercube.ranges[3].from: `x` does not begin with a number\n");
}

TEST_F(SweepStudy, PathsAndValuesAreCheckedBeforeTheFirstCaseAndNamedInTheStudy) {
  expect_refused(
      "workflow: small.yaml\nfixed: {dampin.translational: 0.1}\ngrid:\n  contact_law.frictoin: [0.2]\n  "
      "contact_law.bond_modulus: [10 mm, 20 GPa, 0 GPa]\n",
      "study.yaml:2:9: dampin: is not a known parameter; did you mean `damping`?\n"
      "study.yaml:4:15: contact_law.frictoin: is not a known parameter; did you mean `friction`?\n"
      "study.yaml:5:30: contact_law.bond_modulus: `mm` is a length; a pressure such as Pa, MPa, GPa or psi is needed\n"
      "study.yaml:5:45: contact_law.bond_modulus: must be above 0 GPa, not `0 GPa`\n");
  write("study.yaml",
        "workflow: small.yaml\nlatin_hypercube: {samples: 2, ranges: [{parameter: damping.rotational, from: 1, to: "
        "2}]}\n");
  const Result r = call("sweep study.yaml");
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.text.find("study.yaml:2:78: damping.rotational: must be below 1, not `1."), 0u) << r.text;
  // What stands in the workflow is named there; a file that only some cases need, with its case.
  write("broken.yaml", std::string(small) + "samplng: {every_steps: 3}\n");
  expect_refused("workflow: broken.yaml\ngrid: {seed: [1, 2]}\n",
                 "broken.yaml:9:1: samplng: is not a known parameter; did you mean `sampling`?\n");
  expect_refused("workflow: small.yaml\ngrid: {packing.file: [small.csv, missing.csv]}\n",
                 "study.yaml:2:34: packing from_file: cannot read " + (folder_ / "missing.csv").string() +
                     ": no such file (in case file=missing.csv)\n");
  expect_refused("workflow: small.yaml\ngrid: {contact_law.bond_modulus: [1 GPa, 1000 MPa]}\n",
                 "case 2 is the same as case 1 (in case bond_modulus=1000_MPa)\n");
}

TEST_F(SweepStudy, ColumnsThatChartsAndQuotientsNameAreChecked) {
  expect_refused(
      "workflows: [{name: a, file: small.yaml}, {name: b, file: weak.yaml}]\ngrid: {seed: [1, 2]}\n"
      "derived: [{name: q, numerator: peak_stress_Pa, denominator: b.peak_stress_Pa}]\n"
      "charts: [{x: sed, y: q}, {x: seed, y: q, series: workflow}, {x: seed, y: q}]\n",
      "study.yaml:3:32: derived[0].numerator: `peak_stress_Pa` is neither a parameter that varies nor a value of one "
      "of the "
      "workflows; "
      "did you mean `a.peak_stress_Pa`?\n"
      "study.yaml:4:14: charts[0].x: `sed` is neither a parameter that varies, nor a derived column, nor a value of "
      "one of the "
      "workflows; "
      "did you mean `seed`?\n"
      "study.yaml:4:50: charts[1].series: `workflow` is not a parameter that varies; known here: `seed`\n");
  // Together with what the cases say; and a workflow's name may be what is misspelt.
  expect_refused(
      "workflows: [{name: slow, file: small.yaml}]\ngrid: {contact_law.frictoin: [0.1, 0.2]}\n"
      "charts: [{x: contact_law.frictoin, y: slov.peak_stress_Pa}]\n",
      "study.yaml:2:20: contact_law.frictoin: is not a known parameter; did you mean `friction`?\n"
      "study.yaml:3:39: charts[0].y: `slov.peak_stress_Pa` is neither a parameter that varies, nor a derived column, "
      "nor a value "
      "of one of the workflows; did you mean `slow.peak_stress_Pa`?\n");
  expect_refused(
      "workflow: small.yaml\ngrid: {seed: [1, 2]}\ncharts: [{x: seed, y: a/b}, {x: seed, y: c}, {x: seed, y: c}]\n",
      "study.yaml:3:10: charts[0]: `a/b_over_seed` cannot be a file name; give the chart another `name`\n"
      "study.yaml:3:46: charts[2]: a second chart named `c_over_seed`; give one of them another `name`\n");
}

TEST_F(SweepStudy, RelativePathsStartAtTheFileInWhichTheyAreWritten) {
  fs::create_directories(folder_ / "studies");
  fs::copy(folder_ / "small.csv", folder_ / "studies/own.csv");
  write("studies/study.yaml", "workflow: ../small.yaml\ngrid: {packing.file: [own.csv], seed: [1, 2]}\n");
  const Result r = call("sweep studies/study.yaml --cases");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(rows_of(r.text)[0].at("packing.file"), (folder_ / "studies/own.csv").string());
}

TEST_F(SweepStudy, TheHashIsOfWhatTheResultDependsOn) {
  const std::string study = "workflow: small.yaml\ngrid: {seed: [1, 2]}\n";
  const auto hash = [&] { return cases(study)[0].at("inputs_sha256"); };
  const std::string before = hash();
  write("small.yaml", std::string(small) + "description: other words\n");
  EXPECT_EQ(hash(), before);
  write("small.yaml", std::string(small) + "thickness: 1 m   # the default\n");
  EXPECT_EQ(hash(), before);
  write("small.yaml", std::string(small) + "thickness: 2 m\n");
  EXPECT_NE(hash(), before);
  write("small.yaml", small);
  write("small.csv", content(folder_ / "small.csv") + "100,100,100,1\n");
  EXPECT_NE(hash(), before) << "the content of files counts";
}

TEST_F(SweepStudy, DescribeAndSchema) {
  EXPECT_NE(call("describe sweep").text.find("latin_hypercube"), std::string::npos);
  const Json schema = Json::parse(call("schema sweep").text);
  EXPECT_EQ(schema["title"], "Breccia study");
  EXPECT_TRUE(call("schema sweep").text == content(BRECCIA_SOURCE_DIR "/docs/sweep.schema.json"))
      << "renew it: breccia schema sweep > docs/sweep.schema.json";
}

TEST_F(SweepStudy, TheShippedExampleIsValid) {
  const Result r = call("sweep '" BRECCIA_SOURCE_DIR "/docs/examples/sweep/strength.yaml' --cases");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(rows_of(r.text).size(), 8u);
}

}  // namespace
}  // namespace breccia::testing
