// SPDX-License-Identifier: BSD-3-Clause
// Studies that are run: here, piece by piece, and by Snakemake.
#include <csignal>

#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

class Sweep : public SweepProgram {
 protected:
  static fs::file_time_type changed(const fs::path& file) { return fs::last_write_time(file); }
};

TEST_F(Sweep, EveryCaseAndWorkflowInOneTidyTable) {
  write(
      "study.yaml",
      "workflows: [{name: soft, file: small.yaml}, {name: stiff, file: weak.yaml}]\nfixed: {sampling.every_steps: 4}\n"
      "grid: {contact_law.stiffness_ratio: [2, 4]}\ncollect: [youngs_modulus_Pa, energy.elastic_bonds_J, "
      "poisson_ratio]\n"
      "derived:\n  - {name: modulus_ratio, numerator: stiff.youngs_modulus_Pa, denominator: soft.youngs_modulus_Pa}\n"
      "  - {name: per_ratio, numerator: soft.youngs_modulus_Pa, denominator: contact_law.stiffness_ratio}\n");
  const Result r = call("sweep study.yaml --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  const std::string csv = content(folder_ / "results/study/results.csv");
  EXPECT_EQ(
      csv.substr(0, csv.find('\n')),
      "case,folder,workflow,contact_law.stiffness_ratio,status,youngs_modulus_Pa,energy.elastic_bonds_J,poisson_ratio,"
      "modulus_ratio,per_ratio,error");
  const auto column = [](const char* header, const char* name, const char* unit, const char* holds) {
    return Json{{"header", header}, {"name", name}, {"unit", unit}, {"holds", holds}};
  };
  EXPECT_EQ(Json::parse(content(folder_ / "results/study/results.json")),
            (Json{column("contact_law.stiffness_ratio", "contact_law.stiffness_ratio", "1", "input"),
                  column("youngs_modulus_Pa", "youngs_modulus", "Pa", "value"),
                  column("energy.elastic_bonds_J", "energy.elastic_bonds_J", "", "value"),
                  column("poisson_ratio", "poisson_ratio", "1", "value"),
                  column("modulus_ratio", "modulus_ratio", "1", "derived"),
                  column("per_ratio", "per_ratio", "Pa", "derived")}));
  const Rows rows = results("study");
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows) {
    const fs::path folder = case_of("study", row.at("folder"));
    for (const char* file : {"summary.json", "curves.csv", "resolved.yaml", "run.log", "case.json"})
      EXPECT_TRUE(fs::exists(folder / file)) << file;
    EXPECT_FALSE(fs::exists(folder / "output.log"));
    const Json summary = Json::parse(content(folder / "summary.json"));
    EXPECT_EQ(row.at("status"), "finished");
    EXPECT_EQ(row.at("youngs_modulus_Pa"), summary["youngs_modulus_Pa"].dump());
    EXPECT_EQ(summary["threads"], 1);
    EXPECT_NE(content(folder / "resolved.yaml").find("every_steps: 4"), std::string::npos);
  }
  const double soft = std::stod(rows[2].at("youngs_modulus_Pa")), stiff = std::stod(rows[3].at("youngs_modulus_Pa"));
  EXPECT_DOUBLE_EQ(std::stod(rows[2].at("modulus_ratio")), stiff / soft);
  EXPECT_EQ(rows[3].at("modulus_ratio"), rows[2].at("modulus_ratio")) << "of the point, not of one case";
  EXPECT_DOUBLE_EQ(std::stod(rows[3].at("per_ratio")), soft / 4);
  EXPECT_GT(stiff / soft, 1.2);
  EXPECT_NE(rows[0].at("modulus_ratio"), rows[2].at("modulus_ratio"));
}

TEST_F(Sweep, ACaseIsTheRunThatSetWouldMake) {
  write("study.yaml",
        "workflow: small.yaml\ngrid: {contact_law.bond_modulus: [12 GPa], contact_law.stiffness_ratio: [2]}\n");
  ASSERT_EQ(call("sweep study.yaml").code, 0);
  ASSERT_EQ(call("run small.yaml --threads 1 --output plain --set 'contact_law.bond_modulus=12 GPa' --set "
                 "contact_law.stiffness_ratio=2")
                .code,
            0);
  const fs::path folder = case_of("study", "bond_modulus=12_GPa_stiffness_ratio=2");
  EXPECT_EQ(content(folder / "curves.csv"), content(folder_ / "plain/curves.csv"));
  EXPECT_EQ(content(folder / "resolved.yaml"), content(folder_ / "plain/resolved.yaml"));
}

TEST_F(Sweep, AFailedCaseIsReportedAndStopsNoOther) {
  write("study.yaml", "workflow: small.yaml\ngrid: {packing.file: [bad.csv, small.csv], seed: [1, 2]}\n");
  const Result r = call("sweep study.yaml --jobs 2");
  EXPECT_EQ(r.code, 1);
  const Rows rows = results("study");
  ASSERT_EQ(rows.size(), 4u);
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_EQ(rows[k].at("status"), "failed");
    EXPECT_NE(rows[k].at("error").find("bad.csv"), std::string::npos) << rows[k].at("error");
    EXPECT_EQ(rows[k].at("youngs_modulus_Pa"), "");
    EXPECT_NE(r.text.find("  case " + std::to_string(k + 1) + " (" + rows[k].at("folder") +
                          "): failed: " + rows[k].at("error")),
              std::string::npos)
        << r.text;
  }
  for (const std::size_t k : {2u, 3u}) EXPECT_EQ(rows[k].at("status"), "finished");
  // Once mended only the failed ones are run.
  const auto before = changed(case_of("study", "file=small.csv_seed=1") / "summary.json");
  std::string csv = content(folder_ / "small.csv");
  write("bad.csv", csv);
  EXPECT_EQ(call("sweep study.yaml").code, 2) << "the same packing twice";
  write("bad.csv", csv.replace(csv.find("\n1,1,1,1\n"), 9, "\n1.01,1,1,1\n"));
  const Result mended = call("sweep study.yaml");
  EXPECT_EQ(mended.code, 0) << mended.text;
  EXPECT_NE(mended.text.find("4 cases, 2 to run"), std::string::npos) << mended.text;
  EXPECT_EQ(changed(case_of("study", "file=small.csv_seed=1") / "summary.json"), before);
}

TEST_F(Sweep, GoesOnAfterAKill) {
  write("study.yaml", "workflow: small.yaml\ngrid: {engine.time_step_safety: [0.8, 0.7, 0.001, 0.6]}\n");
  const auto folder = [&](const std::string& v) { return case_of("study", "time_step_safety=" + v); };
  const pid_t first = start({"sweep", "study.yaml", "--jobs", "1"});
  ASSERT_TRUE(within_a_minute([&] { return fs::exists(folder("0.001") / "curves.csv.partial"); }));
  kill(first, SIGKILL);
  waitpid(first, nullptr, 0);
  EXPECT_TRUE(within_a_minute([&] { return case_processes().empty(); })) << "a case goes on without its study";
  EXPECT_EQ(about("study", "time_step_safety=0.7")["status"], "finished");
  EXPECT_NE(about("study", "time_step_safety=0.001")["status"], "finished");
  EXPECT_FALSE(fs::exists(folder("0.6")));
  const auto before = changed(folder("0.8") / "summary.json"), before2 = changed(folder("0.7") / "case.json");
  std::ofstream(folder("0.001") / "left.over") << "x";

  EXPECT_EQ(call("sweep study.yaml --collect").code, 1);
  EXPECT_EQ(results("study")[2].at("status"), "unfinished");
  EXPECT_EQ(results("study")[3].at("status"), "not run");

  const Result r = call("sweep study.yaml --jobs 2");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(r.text.find("4 cases, 2 to run"), std::string::npos) << r.text;
  EXPECT_EQ(changed(folder("0.8") / "summary.json"), before);
  EXPECT_EQ(changed(folder("0.7") / "case.json"), before2);
  EXPECT_TRUE(fs::exists(folder("0.001") / "left.over")) << "it is not Breccia's";
  EXPECT_FALSE(fs::exists(folder("0.001") / "unfinished")) << "what a killed case leaves is removed";
  EXPECT_FALSE(fs::exists(folder("0.001") / "curves.csv.partial"));
  for (const auto& row : results("study")) EXPECT_EQ(row.at("status"), "finished");
}

TEST_F(Sweep, ACaseThatCrashesIsReported) {
  write("study.yaml", "workflow: small.yaml\ngrid: {engine.time_step_safety: [0.00001, 0.8]}\n");
  const pid_t study = start({"sweep", "study.yaml", "--jobs", "1"});
  std::vector<pid_t> cases;
  ASSERT_TRUE(within_a_minute([&] {
    cases = case_processes();
    return !cases.empty() && fs::exists(case_of("study", "time_step_safety=0.00001") / "curves.csv.partial");
  }));
  kill(cases[0], SIGSEGV);
  int status = 0;
  waitpid(study, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const Rows rows = results("study");
  EXPECT_EQ(rows[0].at("status"), "failed");
  EXPECT_NE(rows[0].at("error").find("the process was ended by signal 11"), std::string::npos) << rows[0].at("error");
  EXPECT_EQ(rows[1].at("status"), "finished");
}

TEST_F(Sweep, CtrlCStopsTheCasesAndLosesNothing) {
  write("study.yaml", "workflow: small.yaml\ngrid: {engine.time_step_safety: [0.8, 0.00001, 0.00002, 0.00003]}\n");
  const auto folder = [&](const std::string& v) { return case_of("study", "time_step_safety=" + v); };
  const pid_t study = start({"sweep", "study.yaml", "--jobs", "2"});
  ASSERT_TRUE(within_a_minute([&] {
    return fs::exists(folder("0.00001") / "curves.csv.partial") && fs::exists(folder("0.00002") / "curves.csv.partial");
  }));
  usleep(300000);
  kill(study, SIGINT);
  int status = 0;
  waitpid(study, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(case_processes().empty());
  EXPECT_EQ(about("study", "time_step_safety=0.8")["status"], "finished");
  EXPECT_EQ(about("study", "time_step_safety=0.00001")["status"], "interrupted");
  EXPECT_TRUE(fs::exists(folder("0.00002") / "curves.csv"));
  EXPECT_FALSE(fs::exists(folder("0.00003")));
}

TEST_F(Sweep, FinishedResultsOfOtherInputsAreNeverSilentlyReplaced) {
  const std::string study = "workflow: small.yaml\ngrid: {seed: [1, 2]}\n";
  write("study.yaml", study);
  ASSERT_EQ(call("sweep study.yaml").code, 0);
  const std::string before = content(case_of("study", "seed=1") / "summary.json");
  write("study.yaml", study + "fixed: {contact_law.stiffness_ratio: 2}\n");
  for (const char* how : {"", " --case 1"}) {
    const Result r = call(std::string("sweep study.yaml") + how);
    EXPECT_EQ(r.code, 2);
    EXPECT_NE(r.text.find("--overwrite"), std::string::npos) << r.text;
  }
  EXPECT_EQ(content(case_of("study", "seed=1") / "summary.json"), before);
  EXPECT_EQ(call("sweep study.yaml --collect").code, 1);
  EXPECT_EQ(results("study")[0].at("status"), "other inputs");
  const Result r = call("sweep study.yaml --overwrite");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_NE(content(case_of("study", "seed=1") / "summary.json"), before);
  // More values leave what is there alone.
  const auto time = changed(case_of("study", "seed=2") / "summary.json");
  write("study.yaml", "workflow: small.yaml\nfixed: {contact_law.stiffness_ratio: 2}\ngrid: {seed: [5, 1, 2]}\n");
  EXPECT_NE(call("sweep study.yaml").text.find("3 cases, 1 to run"), std::string::npos);
  EXPECT_EQ(changed(case_of("study", "seed=2") / "summary.json"), time);
  fs::create_directories(folder_ / "mine");
  write("mine/thesis.txt", "dear");
  EXPECT_EQ(call("sweep study.yaml --output mine").code, 2);
  fs::create_directories(folder_ / "other/cases/seed=1");
  write("other/cases/seed=1/thesis.txt", "dear");
  EXPECT_EQ(call("sweep study.yaml --output other").code, 1);
  EXPECT_EQ(content(folder_ / "other/cases/seed=1/thesis.txt"), "dear");
}

TEST_F(Sweep, ValuesThatNoSummaryHasAreTold) {
  write("study.yaml",
        "workflow: small.yaml\ngrid: {seed: [1]}\ncollect: [peak_stres_Pa]\ncharts: [{x: seed, y: youngs_modulus}]\n");
  const Result r = call("sweep study.yaml");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.text.find("warning: collect: no summary has `peak_stres_Pa`; did you mean `peak_stress_Pa`?"),
            std::string::npos)
      << r.text;
  EXPECT_NE(r.text.find("warning: chart `youngs_modulus_over_seed`: no summary has `youngs_modulus`; did you mean "
                        "`youngs_modulus_Pa`?"),
            std::string::npos)
      << r.text;
}

TEST_F(Sweep, CasesThatMakeTheSamePackingAtOnceShareIt) {
  write(
      "study.yaml",
      "workflow: small.yaml\nfixed: {packing: {type: labra_onate, container: {shape: box, size: [6 mm, 6 mm, 12 mm]}, "
      "particles: 150, "
      "radius: {distribution: uniform, min: 0.5 mm, max: 0.6 mm}}}\ngrid: {contact_law.stiffness_ratio: [2, 3, 4, "
      "5]}\n");
  const Result r = call("sweep study.yaml --jobs 4");
  EXPECT_EQ(r.code, 0) << r.text << content(folder_ / "results/study/results.csv");
  int made = 0;
  for (const auto& row : results("study")) {
    const std::string log = content(case_of("study", row.at("folder")) / "run.log");
    made += log.find("(kept from an earlier run)") == log.npos;
    for (const char* trouble : {"damaged", "was not kept"}) EXPECT_EQ(log.find(trouble), log.npos) << log;
  }
  EXPECT_EQ(made, 1);
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "cache/packings"))
    files += entry.path().extension() == ".cbor" ? 1 : 1000;
  EXPECT_EQ(files, 1u);
}

/// A study with a case that fails, run as a whole, then elsewhere.
class SweepElsewhere : public Sweep {
 protected:
  void SetUp() override {
    Sweep::SetUp();
    write("study.yaml",
          "workflow: small.yaml\ngrid: {packing.file: [small.csv, bad.csv], contact_law.stiffness_ratio: [2, 4]}\n");
    ASSERT_EQ(call("sweep study.yaml --output local").code, 1);
  }
  void expect_same(const std::string& folder) const {
    for (const char* file : {"cases.csv", "results.csv", "results.json"})
      EXPECT_EQ(content(folder_ / folder / file), content(folder_ / "local" / file)) << file;
  }
};

TEST_F(SweepElsewhere, CaseByCaseGivesTheSameTables) {
  const Rows cases = rows_of(call("sweep study.yaml --cases").text);
  ASSERT_EQ(cases.size(), 4u);
  for (const auto& row : cases) {
    const bool by_number = row.at("case") < "3", fails = row.at("packing.file").ends_with("bad.csv");
    EXPECT_EQ(call("sweep study.yaml --output apart --case '" + row.at(by_number ? "case" : "folder") + "'").code,
              fails ? 1 : 0);
  }
  EXPECT_EQ(call("sweep study.yaml --output apart --collect").code, 1);
  expect_same("apart");
  EXPECT_NE(call("sweep study.yaml --output apart --case 1").text.find("has finished before"), std::string::npos);
  EXPECT_EQ(call("sweep study.yaml --output apart --case 5").code, 2);
  EXPECT_EQ(call("sweep study.yaml --output apart --case 1 --collect").code, 2);
}

TEST_F(SweepElsewhere, SnakemakeGivesTheSameTables) {
  const std::string snakemake =
      "cd '" + folder_.string() + "' && XDG_CACHE_HOME='" + folder_.string() +
      "' snakemake --snakefile '" BRECCIA_SOURCE_DIR
      "/docs/examples/sweep/Snakefile' --cores 2 --nolock --config study=study.yaml output=snake breccia='" +
      program + "' >snake.txt 2>&1 </dev/null";
  ASSERT_EQ(std::system(snakemake.c_str()), 0) << "tools/packages --tests installs snakemake\n"
                                               << content(folder_ / "snake.txt");
  expect_same("snake");
  // One more value: only its cases are run.
  const fs::path summary = folder_ / "snake/cases/file=small.csv_stiffness_ratio=4/summary.json";
  const auto before = changed(summary);
  write("study.yaml",
        "workflow: small.yaml\ngrid: {packing.file: [small.csv], contact_law.stiffness_ratio: [2, 3, 4]}\n");
  ASSERT_EQ(std::system(snakemake.c_str()), 0) << content(folder_ / "snake.txt");
  EXPECT_EQ(rows_of(content(folder_ / "snake/results.csv")).size(), 3u);
  EXPECT_EQ(changed(summary), before);
}

}  // namespace
}  // namespace breccia::testing
