// SPDX-License-Identifier: BSD-3-Clause
// Calibrations that are run: parameters that are known are found again, by the same path however often it is
// interrupted.
#include <cmath>
#include <csignal>

#include "sweep_support.hpp"

namespace breccia::testing {
namespace {

/// A small crystal that fails; strengths scatter from bond to bond, hence from seed to seed.
class Calibrate : public SweepProgram {
 protected:
  void SetUp() override {
    SweepProgram::SetUp();
    write("rock.yaml",
          R"(packing: {type: regular, lattice: fcc, container: {shape: box, size: [6 mm, 6 mm, 9 mm]}, radius: 1 mm}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.01}
contact_law:
  type: elastic_brittle
  bond_modulus: 10 GPa
  stiffness_ratio: 3.7
  tensile_strength: {mean: 40 MPa, distribution: weibull, modulus: 8}
  shear_strength: {mean: 40 MPa, distribution: weibull, modulus: 8}
  friction: 0.5
damping: {translational: 0.7, rotational: 0.7}
protocol: {type: uniaxial_compression, platen_velocity: 0.4 m/s, platen_stiffness: 15 MN/m, max_strain: 3 %, stop_stress_ratio: 0.7}
sampling: {every_steps: 5}
postprocessors: [{type: stress}, {type: bagi_strain}, {type: elastic_constants}]
renderers: []
)");
  }

  /// Runs need something that proposes the points.
  static bool has_search() { return fs::exists(BRECCIA_BINARY_DIR "/lib/breccia/" + search_file()); }
  static std::string search_file() { return "breccia_search.kriging.so"; }

  /// Two parameters, two targets; `budget` and whatever stands below it.
  std::string file(double modulus, double strength, const std::string& more) const {
    std::ostringstream text;
    text << "workflows: {test: {file: rock.yaml}}\n"
            "targets:\n"
            "  E: {key: youngs_modulus_Pa, value: "
         << modulus
         << " Pa, scatter: 2 %}\n"
            "  ucs: {key: peak_stress_Pa, value: "
         << strength
         << " Pa, scatter: 5 %}\n"
            "parameters:\n"
            "  modulus: {path: contact_law.bond_modulus, from: 4 GPa, to: 60 GPa, scale: log}\n"
            "  strength: {paths: [contact_law.tensile_strength.mean, contact_law.shear_strength.mean], from: 8 MPa, "
            "to: 200 MPa, "
            "scale: log}\n"
         << more;
    return text.str();
  }

  struct Rock {
    double modulus = 0, strength = 0;
  };
  /// Means of some seeds with 17 GPa and 60 MPa.
  Rock known_rock() const {
    Rock mean;
    for (const std::string seed : {"501", "502", "503", "504", "505"}) {
      const std::string out = "known" + seed;
      EXPECT_EQ(call("run rock.yaml --threads 1 --output " + out + " --set seed=" + seed +
                     " --set 'contact_law.bond_modulus=17 GPa' --set 'contact_law.tensile_strength.mean=60 MPa' --set "
                     "'contact_law.shear_strength.mean=60 MPa'")
                    .code,
                0);
      const Json summary = Json::parse(content(folder_ / out / "summary.json"));
      mean.modulus += summary["youngs_modulus_Pa"].get<double>() / 5;
      mean.strength += summary["peak_stress_Pa"].get<double>() / 5;
    }
    return mean;
  }
  /// Terminal, report.md and `breccia report` tell of the calibration in `out` in units that people read.
  void tells_it_all(const Result& said, const Json& o, const Rows& runs) const {
    const auto four = [](double v) {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", v);
      return std::string(text);
    };
    const double modulus = o["parameters"]["modulus"]["best"].get<double>() / 1e9,
                 stiffness = o["targets"]["E"]["measured"].get<double>() / 1e9;
    EXPECT_TRUE(has(said.text, "modulus: " + four(modulus) + " GPa (90 %: ")) << said.text;
    const std::string markdown = content(folder_ / "out/report.md");
    EXPECT_TRUE(has(markdown, "| modulus | " + four(modulus) + " GPa | ")) << markdown;
    EXPECT_TRUE(has(markdown, "| 4 GPa to 60 GPa |")) << markdown;
    EXPECT_TRUE(has(markdown, "| " + four(stiffness) + " GPa | 3 |"))
        << "given in Pa, with a power of ten: " << markdown;
    for (const std::string& text : {said.text, markdown}) {
      EXPECT_FALSE(has(text, "e+")) << text;
      EXPECT_FALSE(has(text, " Pa ")) << text;
    }
    const Result report = call("report out --author 'A. Name'");
    ASSERT_EQ(report.code, 0) << report.text;
    const std::string html = content(folder_ / "out/report.html"), nbsp = "\u00A0";
    for (const std::string& part :
         {std::string("Report of a calibration"), std::string("2 parameters, 2 targets; 20 runs at "),
          std::string("A. Name"), "<td class=\"n\">" + four(modulus) + nbsp + "GPa</td>",
          "<td class=\"n\">" + four(stiffness) + nbsp + "GPa</td><td class=\"n\">3</td>", "4 to 60" + nbsp + "GPa",
          std::string("Modulus (GPa)"), std::string("Strength (MPa)"), std::string("What depends on what"),
          std::string("Course of the search"), std::string("<code>contact_law.bond_modulus</code>"),
          std::string("best/test.yaml"), std::string("Jones, Schonlau, Welch (1998)")})
      EXPECT_TRUE(has(html, part)) << part;
    for (const char* part : {"<script", "href=\"http", "src=\"http", "Runs without results", "contradict each other"})
      EXPECT_FALSE(has(html, part)) << part;
    const std::string methods = content(folder_ / "out/methods.md");
    EXPECT_TRUE(has(methods, "Sought were modulus (4 to 60 GPa) and strength (8 to 200 MPa), such that")) << methods;
    EXPECT_TRUE(has(methods, "Best were modulus (" + four(modulus) + " GPa; 90 % interval ")) << methods;
    // What the runs have in common is told of one of those that have the best parameters.
    std::size_t of_check = 0;
    for (const auto& row : runs)
      if (row.at("point") == runs.back().at("point"))
        of_check += has(methods, row.at("folder").substr(5) + "” stands here");
    EXPECT_EQ(of_check, 1u) << methods;
    const std::string crate = content(folder_ / "out/ro-crate-metadata.json");
    EXPECT_TRUE(has(crate, "Results of one run of the calibration")) << crate;
    EXPECT_EQ(call("report out").code, 2) << "there is one already";
  }

  /// Summaries of the runs that have come to their end, and since when they are there.
  std::map<fs::path, fs::file_time_type> finished(const std::string& folder) const {
    std::map<fs::path, fs::file_time_type> all;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / folder / "cases", none))
      if (has(content(entry.path() / "case.json"), "\"status\": \"finished\""))
        all[entry.path() / "summary.json"] = fs::last_write_time(entry.path() / "summary.json");
    return all;
  }

  Json outcome(const std::string& folder) const { return Json::parse(content(folder_ / folder / "calibration.json")); }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }
};

#define NEEDS_SEARCH() \
  if (!has_search()) GTEST_SKIP() << "built without OpenTURNS: nothing proposes points"

constexpr const char* small_budget = "budget: {runs: 12, start_packings: 3, check_packings: 1, batch: 3}\n";

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
