// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of calibrations share: a rock whose parameters are sought.
#pragma once

#include "sweep_support.hpp"

namespace breccia::testing {

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
    for (const auto& entry : fs::directory_iterator(folder_ / folder / "cases", none)) {
      if (!has(content(entry.path() / "case.json"), "\"status\": \"finished\"")) continue;
      std::error_code comes_yet;  // files of a run that ends are moved to their place one by one
      const auto since = fs::last_write_time(entry.path() / "summary.json", comes_yet);
      if (!comes_yet) all[entry.path() / "summary.json"] = since;
    }
    return all;
  }

  Json outcome(const std::string& folder) const { return Json::parse(content(folder_ / folder / "calibration.json")); }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }
};

#define NEEDS_SEARCH() \
  if (!has_search()) GTEST_SKIP() << "built without OpenTURNS: nothing proposes points"

constexpr const char* small_budget = "budget: {runs: 12, start_packings: 3, check_packings: 1, batch: 3}\n";

}  // namespace breccia::testing
