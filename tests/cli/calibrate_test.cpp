// SPDX-License-Identifier: BSD-3-Clause
// Calibrations that are run: parameters that are known are found again, by the same path however often it is
// interrupted.
#include <cmath>
#include <csignal>

#include "calibrate_support.hpp"

namespace breccia::testing {
namespace {

TEST_F(Calibrate, FindsParametersThatAreKnown) {
  NEEDS_SEARCH();
  const Rock rock = known_rock();
  write("c.yaml", file(rock.modulus, rock.strength, "budget: {runs: 20, start_packings: 3, check_packings: 3}\n"));
  const Result r = call("calibrate c.yaml --output out --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  const Json o = outcome("out");
  EXPECT_EQ(o["runs"], 20);
  EXPECT_EQ(o["failed_runs"], 0) << r.text;
  EXPECT_EQ(o["complete"], true);
  const Json &modulus = o["parameters"]["modulus"], &strength = o["parameters"]["strength"];
  // Its scatter is 2 % and nothing in the specimen's stiffness depends on the seed.
  EXPECT_NEAR(modulus["best"].get<double>(), 17e9, 0.03 * 17e9);
  EXPECT_LE(modulus["interval_90"][0].get<double>(), 17e9);
  EXPECT_GE(modulus["interval_90"][1].get<double>(), 17e9);
  // Of some 70 bonds the weaker ones decide: that scatters by some ten per cent.
  EXPECT_NEAR(strength["best"].get<double>(), 60e6, 0.15 * 60e6);
  EXPECT_LE(strength["interval_90"][0].get<double>(), 60e6);
  EXPECT_GE(strength["interval_90"][1].get<double>(), 60e6);
  EXPECT_EQ(modulus["unit"], "Pa");
  // Stiffness is the modulus alone; strength is the bonds' alone, but for what the modulus leaves of inertia.
  EXPECT_GT(modulus["sensitivity"]["E"]["total"].get<double>(), 0.9);
  EXPECT_LT(strength["sensitivity"]["E"]["total"].get<double>(), 0.1);
  EXPECT_GT(strength["sensitivity"]["ucs"]["total"].get<double>(), 0.7);
  EXPECT_LT(std::abs(o["targets"]["E"]["residual_over_scatter_of_experiment"].get<double>()), 2);

  // A workflow to go on with: it gives what was wanted.
  const Result again = call("run out/best/test.yaml --threads 1 --output again");
  ASSERT_EQ(again.code, 0) << again.text;
  EXPECT_NEAR(Json::parse(content(folder_ / "again/summary.json"))["youngs_modulus_Pa"].get<double>(), rock.modulus,
              0.03 * rock.modulus);
  for (const char* f : {"runs.csv", "points.csv", "report.md", "breccia.json"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / f)) << f;
  const Rows rows = rows_of(content(folder_ / "out/runs.csv"));
  ASSERT_EQ(rows.size(), 20u);
  std::set<std::string> seeds;
  for (const auto& row : rows) {
    seeds.insert(row.at("seed"));
    EXPECT_TRUE(fs::exists(folder_ / "out/cases" / row.at("folder") / "summary.json"));
  }
  EXPECT_EQ(seeds.size(), 20u) << "each run has a packing of its own";

  // All of it once more: nothing is run.
  const Result collected = call("calibrate c.yaml --output out --collect");
  EXPECT_EQ(collected.code, 0) << collected.text;
  EXPECT_EQ(outcome("out"), o);
  tells_it_all(r, o, rows);
}

TEST_F(Calibrate, TheSamePathOnAnyNumberOfJobsAfterAKill) {
  NEEDS_SEARCH();
  write("c.yaml", file(20e9, 50e6, small_budget));
  ASSERT_EQ(call("calibrate c.yaml --output one --jobs 1").code, 0);
  const std::string runs = content(folder_ / "one/runs.csv");
  const pid_t first = start({"calibrate", "c.yaml", "--output", "two", "--jobs", "2"});
  ASSERT_TRUE(within_a_minute([&] { return finished("two").size() >= 4; }));
  kill(first, SIGKILL);
  waitpid(first, nullptr, 0);
  usleep(300000);  // its runs end with it
  const auto before = finished("two");
  ASSERT_LT(before.size(), 12u);
  EXPECT_FALSE(fs::exists(folder_ / "two/calibration.json"));
  const Result r = call("calibrate c.yaml --output two --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(content(folder_ / "two/runs.csv"), runs);
  EXPECT_EQ(outcome("two"), outcome("one"));
  for (const auto& [file, time] : before) EXPECT_EQ(fs::last_write_time(file), time) << file;
}

/// Run by run, as a workflow manager would: the first point, then the batch that follows from it; then at one go.
TEST_F(Calibrate, TheSamePathPieceByPiece) {
  NEEDS_SEARCH();
  write("c.yaml", file(20e9, 50e6, small_budget));
  Rows rows;
  for (const std::size_t known : {3u, 6u}) {
    const Result listed = call("calibrate c.yaml --output three --cases");
    ASSERT_EQ(listed.code, 0) << listed.text;
    rows = rows_of(listed.text);
    ASSERT_EQ(rows.size(), known);
    for (std::size_t k = 0; k < known; ++k) {
      if (rows[k].at("status") == "finished") continue;
      const Result one = call("calibrate c.yaml --output three --case " + rows[k].at("case"));
      EXPECT_EQ(one.code, 0) << one.text;
    }
  }
  EXPECT_EQ(call("calibrate c.yaml --output three --case 99").code, 2);
  ASSERT_EQ(call("calibrate c.yaml --output three --collect").code, 1);  // not yet at its end
  EXPECT_EQ(outcome("three")["complete"], false);
  EXPECT_EQ(outcome("three")["runs"], 6);
  const Result early = call("report three");
  EXPECT_EQ(early.code, 0) << early.text;
  EXPECT_TRUE(has(content(folder_ / "three/report.html"), "The calibration has not come to its end."));
  fs::remove(folder_ / "three/calibration.json");
  const Result none = call("report three --overwrite");
  EXPECT_EQ(none.code, 2);
  EXPECT_TRUE(has(none.text, "the calibration in three has no result yet")) << none.text;
  const auto before = finished("three");
  ASSERT_EQ(before.size(), 6u);
  ASSERT_EQ(call("calibrate c.yaml --output three --jobs 2").code, 0);
  const Rows all = rows_of(content(folder_ / "three/runs.csv"));
  ASSERT_EQ(all.size(), 12u);
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(all[k].at("folder"), rows[k].at("folder"));
  for (const auto& [file, time] : before) EXPECT_EQ(fs::last_write_time(file), time) << file;
}

TEST_F(Calibrate, SmallSpecimensFirst) {
  NEEDS_SEARCH();
  write("c.yaml", file(20e9, 50e6,
                       "budget:\n  runs: 16\n  check_packings: 2\n  stages:\n"
                       "    - {name: fast, share: 60 %, set: {protocol.platen_velocity: 0.8 m/s}}\n"
                       "    - {name: slow, share: 40 %}\n"));
  const Result r = call("calibrate c.yaml --output out --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  const Rows rows = rows_of(content(folder_ / "out/points.csv"));
  std::size_t fast = 0;
  for (const auto& row : rows) fast += row.at("stage") == "fast";
  EXPECT_EQ(fast, 7u);  // of 12 points: 16 runs less 2 for the check and 2 more at the start
  EXPECT_EQ(rows.back().at("stage"), "slow");
  EXPECT_EQ(rows.back().at("why"), "check");
  EXPECT_FALSE(has(content(folder_ / "out/best/test.yaml"), "platen_velocity: 0.8"));
}

TEST_F(Calibrate, WhatIsWrongWithTheTaskIsSaid) {
  NEEDS_SEARCH();
  // Two tests of one specimen cannot have two moduli.
  write("contradiction.yaml",
        "workflows: {a: {file: small.yaml}, b: {file: weak.yaml, set: {contact_law.stiffness_ratio: 3.7}}}\n"
        "targets:\n  soft: {workflow: a, key: youngs_modulus_Pa, value: 10 GPa, scatter: 3 %}\n"
        "  stiff: {workflow: b, key: youngs_modulus_Pa, value: 20 GPa, scatter: 3 %}\n"
        "parameters:\n  modulus: {path: contact_law.bond_modulus, from: 4 GPa, to: 60 GPa, scale: log}\n"
        "budget: {runs: 14, start_packings: 2, check_packings: 1}\n");
  const Result c = call("calibrate contradiction.yaml --output contradiction --jobs 2");
  ASSERT_EQ(c.code, 0) << c.text;
  EXPECT_TRUE(has(c.text, "The targets contradict each other")) << c.text;
  EXPECT_TRUE(fs::exists(folder_ / "contradiction/pareto.csv"));
  const Result report = call("report contradiction");
  ASSERT_EQ(report.code, 0) << report.text;
  const std::string html = content(folder_ / "contradiction/report.html");
  for (const char* part :
       {"Targets that contradict each other", "Soft, scatters away", "The targets contradict each other: each can be"})
    EXPECT_TRUE(has(html, part)) << part;

  write("idle.yaml",
        "workflows: {a: {file: small.yaml}}\n"
        "targets: {E: {key: youngs_modulus_Pa, value: 90 GPa, scatter: 3 %}}\n"
        "parameters:\n  modulus: {path: contact_law.bond_modulus, from: 4 GPa, to: 20 GPa, scale: log}\n"
        "  friction: {path: contact_law.friction, from: 0.1, to: 1}\n"
        "budget: {runs: 11, start_packings: 2, check_packings: 1}\n");
  const Result idle = call("calibrate idle.yaml --output idle --jobs 2");
  ASSERT_EQ(idle.code, 0) << idle.text;
  EXPECT_TRUE(has(idle.text, "Hardly anything depends on `friction`")) << idle.text;
  EXPECT_TRUE(has(idle.text, "The best `modulus`, ")) << idle.text;
  EXPECT_TRUE(has(idle.text, "is at the upper end of its range")) << idle.text;
  EXPECT_TRUE(has(idle.text, "`E` = 90 GPa cannot be reached")) << idle.text;
}

TEST_F(Calibrate, FailedRunsAreKeptAndTold) {
  NEEDS_SEARCH();
  // No balance of energy closes to a part in a billion: with such a limit every run fails, with a larger one none.
  std::string text = file(20e9, 50e6, "budget: {runs: 14, start_packings: 2, check_packings: 1, batch: 3}\n");
  const std::string after = "from: 8 MPa, to: 200 MPa, scale: log}\n";
  text.insert(text.find(after) + after.size(),
              "  limit: {path: engine.energy_error_limit, from: 1e-12, to: 1, scale: log, start: 0.5}\n");
  write("c.yaml", text);
  const Result r = call("calibrate c.yaml --output out --jobs 2");
  ASSERT_EQ(r.code, 0) << r.text;
  const Json o = outcome("out");
  const std::size_t told = o["failed_runs"].get<std::size_t>();
  EXPECT_GT(told, 0u);
  EXPECT_LT(told, 14u);
  EXPECT_NE(r.text.find("runs have failed; runs.csv says which and why"), std::string::npos) << r.text;
  const auto failures = [&] {
    std::size_t failed = 0;
    for (const auto& row : rows_of(content(folder_ / "out/runs.csv"))) {
      failed += row.at("status") == "failed";
      EXPECT_EQ(row.at("status") == "failed", !row.at("error").empty());
    }
    return failed;
  };
  EXPECT_EQ(failures(), told);
  ASSERT_EQ(call("report out").code, 0);
  EXPECT_TRUE(has(content(folder_ / "out/report.html"), "Runs without results"));
  // They are not run again unless one says so.
  const Result again = call("calibrate c.yaml --output out --jobs 2");
  EXPECT_EQ(again.text.find("] test_"), std::string::npos) << again.text;
  const Result retried = call("calibrate c.yaml --output out --jobs 2 --retry-failed");
  EXPECT_NE(retried.text.find("] test_"), std::string::npos) << retried.text;
  EXPECT_EQ(failures(), told);
}

TEST_F(Calibrate, RunsThatTakeTooLongHaveFailedAndStaySo) {
  NEEDS_SEARCH();
  // A platen that hardly moves: with it a run would take hours, with the largest velocity a part of a second.
  const auto with = [&](const std::string& budget) {
    std::string text = file(20e9, 50e6, "budget: {runs: 8, start_packings: 2, check_packings: 1" + budget + "}\n");
    const std::string after = "to: 200 MPa, scale: log}\n";
    text.insert(
        text.find(after) + after.size(),
        "  velocity: {path: protocol.platen_velocity, from: 1e-8 m/s, to: 0.4 m/s, scale: log, start: 0.4 m/s}\n");
    return text;
  };
  write("c.yaml", with(", run_time: 2500 ms"));
  const Result first = call("calibrate c.yaml --output out --jobs 2");
  EXPECT_TRUE(has(first.text, "failed: took longer than the 2500 ms that a run may take")) << first.text;
  EXPECT_TRUE(has(first.text, "of the failed runs took longer than `run_time` of the budget, 2500 ms.")) << first.text;
  const Json o = outcome("out");
  const std::size_t ended = o["runs_out_of_time"].get<std::size_t>();
  EXPECT_GT(ended, 0u);
  EXPECT_LE(ended, o["failed_runs"].get<std::size_t>());
  EXPECT_EQ(o["run_time_limit_s"], 2.5);
  const std::string runs = content(folder_ / "out/runs.csv");
  std::size_t told = 0;
  for (const auto& row : rows_of(runs)) {
    const bool of_time = has(row.at("error"), "took longer than the 2500 ms");
    told += of_time;
    if (!of_time) continue;
    EXPECT_EQ(row.at("status"), "failed");
    fs::path about = folder_ / "out/cases" / row.at("folder") / "case.json";  // or where it was still packing
    if (!fs::exists(about)) about = about.parent_path() / "unfinished/case.json";
    EXPECT_EQ(Json::parse(content(about), nullptr, false).value("out_of_time", false), true) << about;
  }
  EXPECT_EQ(told, ended);
  // However long they may take now, what was decided stands, and so does the path.
  for (const char* budget : {", run_time: 2500 ms", ", run_time: 10 h", ""}) {
    write("c.yaml", with(budget));
    const Result again = call("calibrate c.yaml --output out --jobs 2");
    EXPECT_EQ(again.code, first.code) << again.text;
    EXPECT_EQ(again.text.find("] test_"), std::string::npos) << again.text;
    EXPECT_EQ(content(folder_ / "out/runs.csv"), runs);
    EXPECT_EQ(outcome("out")["runs_out_of_time"], ended);
  }
}

}  // namespace
}  // namespace breccia::testing
