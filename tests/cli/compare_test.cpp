// SPDX-License-Identifier: BSD-3-Clause
// breccia compare on result folders written by hand. Charts have their tests beside the renderer's.
#include "program.hpp"

namespace breccia::testing {
namespace {

class Compare : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    add("a", R"({"workflow": "first", "interrupted": false, "wall_time_s": 3.5, "bonds": 200, "porosity": 0.25,
 "peak_stress_Pa": 330000000.0, "youngs_modulus_Pa": null, "fabric_diagonal": [0.3, 0.3, 0.4],
 "damage": {"fragments": 7, "deeper": {"ratio": 0.125}},
 "reference": {"source": "A paper", "peak_stress_Pa": 300000000.0, "youngs_modulus_Pa": 2e10},
 "units": {"peak_stress_Pa": "Pa", "youngs_modulus_Pa": "Pa", "wall_time_s": "s"}})");
    add("b", R"({"workflow": "second", "interrupted": true, "wall_time_s": 4, "bonds": 100, "coordination_number": 9.5,
 "porosity": 0.5, "damage": {"bonds_broken": 12}, "reference": {}})");
  }

  void add(const std::string& run, const std::string& summary) const {
    fs::create_directories(folder_ / run);
    std::ofstream(folder_ / run / "summary.json") << summary;
    std::ofstream(folder_ / run / "curves.csv")
        << "time_s,axial_strain,axial_stress_Pa\n0,0,0\n1,0.001,2e7\n2,0.002,3e7\n";
  }
  /// Both streams, after the exit code.
  std::string call(const std::string& arguments) const {
    const Result r = Program::call("compare " + arguments);
    return std::to_string(r.code) + ": " + r.text;
  }
  std::string made(const std::string& file) const { return content(folder_ / "out" / file); }
  void expect_refused(const std::string& arguments, const std::string& why) const {
    const std::string text = call(arguments);
    EXPECT_EQ(text.substr(0, 2), "2:") << text;
    EXPECT_NE(text.find(why), std::string::npos) << text;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << text;
  }
};

TEST_F(Compare, EveryNumberOfEveryRun) {
  const std::string text = call("a b/ -o out");
  ASSERT_EQ(text.substr(0, 2), "0:") << text;
  EXPECT_EQ(
      made("comparison.csv"),
      "label,interrupted,wall_time_s,bonds,coordination_number,porosity,peak_stress_Pa,youngs_modulus_Pa,"
      "damage.fragments,damage.deeper.ratio,damage.bonds_broken,reference.peak_stress_Pa,reference.youngs_modulus_Pa\n"
      "a,0,3.5,200,,0.25,330000000.0,,7,0.125,,300000000.0,20000000000.0\n"
      "b,1,4,100,9.5,0.5,,,,,12,,\n");
  EXPECT_NE(text.find("warning: the run `b` was stopped before its end"), std::string::npos) << text;
}

TEST_F(Compare, TheTableForReadersHasUnitsReferencesAndDistances) {
  ASSERT_EQ(call("a b -o out").substr(0, 2), "0:");
  const std::string text = made("comparison.md");
  const std::string table = text.substr(text.find("| | a"), text.find("\n\n", text.find("| | a")) - text.find("| | a"));
  EXPECT_EQ(
      table,
      "| | a | reference | b |\n|---|---:|---:|---:|\n| workflow | first |  | second |\n| interrupted | no |  | yes |\n"
      "| bonds | 200 |  | 100 |\n| coordination number |  |  | 9.5 |\n| porosity | 0.25 |  | 0.5 |\n"
      "| peak stress (MPa) | 330 | 300 (+10.0 %) |  |\n| Young's modulus (GPa) |  | 20 |  |");
  EXPECT_NE(text.find("reference: A paper"), std::string::npos);
  EXPECT_EQ(text.find("wall"), std::string::npos) << "bookkeeping";
}

TEST_F(Compare, LabelsInOnePieceOrSeveral) {
  ASSERT_EQ(call("a b -o out --labels 'model 1=a,model 2=b'").substr(0, 2), "0:");
  const std::string one = made("comparison.csv");
  EXPECT_NE(one.find("\nmodel 1,0,"), std::string::npos) << one;
  ASSERT_EQ(call("a b -o again --labels 'model 2=./b/' --labels 'model 1=a'").substr(0, 2), "0:");
  EXPECT_EQ(content(folder_ / "again/comparison.csv"), one) << "the order of the labels does not count";
}

/// A shell sorts `results/*` as 10, 20, 5: a label by position lands at another run.
TEST_F(Compare, ALabelNeverGoesByPosition) {
  for (const char* run : {"10", "20", "5"})
    add(run, std::string(R"({"workflow": "w", "interrupted": false, "bonds": )") + run + "}");
  expect_refused("10 20 5 -o out --labels '5 MPa,10 MPa,20 MPa'", "write --labels 'LABEL=DIR'");
  expect_refused("10 20 5 -o out --labels '5 MPa=nowhere'", "names none of the runs");
  expect_refused("10 20 5 -o out --labels '=5'", "the label of 5 is empty");
  expect_refused("10 20 5 -o out --labels 'x=5,y=5'", "a second label for the run 5");
  ASSERT_EQ(call("10 20 5 -o out --labels '5 MPa=5,p=10 MPa=10'").substr(0, 2), "0:");
  const std::string csv = made("comparison.csv");
  EXPECT_NE(csv.find("\n5 MPa,0,5\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\np=10 MPa,0,10\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n20,0,20\n"), std::string::npos) << "without a label: the folder's name\n" << csv;
}

TEST_F(Compare, AStudyStandsForItsCases) {
  for (const char* f : {"0.1", "0.02", "0.3"})
    add(std::string("study/cases/friction=") + f, std::string(R"({"interrupted": false, "x": )") + f + "}");
  fs::create_directories(folder_ / "study/cases/friction=0.4");  // has not finished
  std::ofstream(folder_ / "study/results.csv")
      << "case,folder,f\n1,friction=0.02,0.02\n2,friction=0.1,0.1\n3,friction=0.3,0.3\n";
  ASSERT_EQ(call("study -o out --labels rough=study/cases/friction=0.3").substr(0, 2), "0:");
  EXPECT_EQ(made("comparison.csv"), "label,interrupted,x\nfriction=0.02,0,0.02\nfriction=0.1,0,0.1\nrough,0,0.3\n");
}

/// The stiffness and the moment are written alike.
TEST_F(Compare, ANewtonMetreIsNoMetre) {
  add("m",
      R"({"bending_moment_N_m": 2, "platen_stiffness_N_m": 3, "viscosity_Pa_s": 4, "rate_1_s": 5, "drift_m_s": 6, "units":
          {"bending_moment_N_m": "N m", "platen_stiffness_N_m": "N/m", "viscosity_Pa_s": "Pa s", "rate_1_s": "1/s",
           "drift_m_s": "m/s"}})");
  ASSERT_EQ(call("m -o out").substr(0, 2), "0:");
  for (const char* row : {"| bending moment (N m) | 2 |", "| platen stiffness (N/m) | 3 |", "| viscosity (Pa s) | 4 |",
                          "| rate (1/s) | 5 |", "| drift (m/s) | 6 |"})
    EXPECT_NE(made("comparison.md").find(row), std::string::npos) << row << "\n" << made("comparison.md");
}

TEST_F(Compare, NamesMetTwiceAreToldApart) {
  add("other/a", R"({"bonds": 1})");
  add("third/a", R"({"bonds": 2})");
  ASSERT_EQ(call("other/a third/a b b -o out").substr(0, 2), "0:");
  const std::string parent = folder_.filename().string(), csv = made("comparison.csv");
  EXPECT_NE(csv.find("\nother/a,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nthird/a,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n" + parent + "/b (1),"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n" + parent + "/b (2),"), std::string::npos) << csv;
}

TEST_F(Compare, FilesAreNeverSilentlyReplaced) {
  ASSERT_EQ(call("a b -o out").substr(0, 2), "0:");
  std::ofstream(folder_ / "out/thesis.txt") << "dear";
  const std::string before = made("comparison.csv");
  const std::string again = call("b -o out");
  EXPECT_EQ(again.substr(0, 2), "2:");
  EXPECT_NE(again.find("--overwrite"), std::string::npos) << again;
  EXPECT_EQ(made("comparison.csv"), before);
  ASSERT_EQ(call("b -o out --overwrite").substr(0, 2), "0:");
  EXPECT_NE(made("comparison.csv"), before);
  EXPECT_EQ(made("thesis.txt"), "dear");
  for (const auto& entry : fs::directory_iterator(folder_ / "out")) EXPECT_NE(entry.path().extension(), ".partial");
  EXPECT_NE(call("a b -o b --overwrite").find("which is one of the runs"), std::string::npos);
  EXPECT_NE(call("b -o a --overwrite").find("holds the results of a run"), std::string::npos);
}

TEST_F(Compare, AFileOfTheUsersIsNotReplaced) {
  fs::create_directories(folder_ / "out");
  write("out/comparison.md", "dear");
  EXPECT_EQ(call("a b -o out --overwrite").substr(0, 2), "2:");
  EXPECT_EQ(made("comparison.md"), "dear");
  EXPECT_FALSE(fs::exists(folder_ / "out/comparison.csv"));
  write("input.yaml", "name: input\n");
  EXPECT_NE(call("input.yaml b -o other").find("is an input file"), std::string::npos);
}

TEST_F(Compare, WhatIsNoFinishedRunIsNamed) {
  expect_refused("a nowhere -o out", "cannot read nowhere: no such folder");
  expect_refused("a a/curves.csv -o out", "a/curves.csv is a file");
  fs::create_directories(folder_ / "empty");
  expect_refused("a empty -o out", "empty is not the result folder of a run: it has no summary.json");
  std::ofstream(folder_ / "empty/curves.csv.partial") << "time_s\n";
  expect_refused("a empty -o out", "the run in empty has not finished");
  add("damaged", R"({"bonds": )");
  expect_refused("a damaged -o out", "damaged/summary.json is damaged");
  fs::remove(folder_ / "b/curves.csv");
  expect_refused("a b -o out", "b is not a whole result folder: it has no curves.csv");
  expect_refused("-o out", "DIR");
}

/// sigma_1 = 20 MPa + 4 sigma_3: c = 5 MPa, sin(phi) = 0.6. The tensile test and the one in a rigid cell are not
/// fitted.
TEST_F(Compare, StrengthEnvelope) {
  const auto test = [](double minor, double major, const char* more = "") {
    return R"({"protocol_x": {"peak_platen_stress_Pa": )" + std::to_string(major) +
           R"(, "peak_deviatoric_platen_stress_Pa": )" + std::to_string(major - minor) + more + "}}";
  };
  add("ucs", test(0, 20e6));
  add("t5", test(5e6, 40e6));
  add("t10", test(10e6, 60e6));
  add("cell", test(1e6, 99e6, R"(, "cell_pressure_at_end_Pa": 1e6)"));
  add("disc", R"({"brazilian_tensile_strength_Pa": 3e6})");
  add("pulled", R"({"direct_tension": {"peak_tension_Pa": 2e6}})");
  ASSERT_EQ(call("ucs t5 t10 cell disc pulled a -o out").substr(0, 2), "0:");
  const auto json = nlohmann::json::parse(made("strength_envelope.json"));
  EXPECT_NEAR(json["uniaxial_strength_Pa"].get<double>(), 20e6, 1);
  EXPECT_NEAR(json["cohesion_Pa"].get<double>(), 5e6, 1);
  EXPECT_NEAR(std::sin(json["friction_angle_rad"].get<double>()), 0.6, 1e-9);
  ASSERT_EQ(json["tests"].size(), 5u);
  EXPECT_EQ(json["tests"][3]["label"], "disc");
  EXPECT_EQ(json["tests"][3]["minor_stress_Pa"], -3e6);
  EXPECT_EQ(json["tests"][3]["major_stress_Pa"], 9e6);
  EXPECT_EQ(json["tests"][3]["in_fit"], false);
  EXPECT_EQ(json["tests"][4]["minor_stress_Pa"], -2e6);
  EXPECT_EQ(json["tests"][4]["major_stress_Pa"], 0);
  EXPECT_EQ(json["tests"][4]["in_fit"], false);
  const std::string text = made("comparison.md");
  EXPECT_NE(text.find("sigma_1 = 20 MPa + 4 sigma_3: cohesion 5 MPa, angle of friction 36.9°"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| t5 | 5 | 40 |"), std::string::npos) << text;
  ASSERT_EQ(call("ucs disc a -o flat").substr(0, 2), "0:");
  EXPECT_FALSE(fs::exists(folder_ / "flat/strength_envelope.json"));
}

}  // namespace
}  // namespace breccia::testing
