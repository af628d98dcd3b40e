// SPDX-License-Identifier: BSD-3-Clause
// Every workflow that is shipped, with a specimen so small that it runs in a second or two: same shape, same sizes of
// particles, same everything else.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "program.hpp"

namespace breccia::testing {
namespace {

const std::string workflows = BRECCIA_SOURCE_DIR "/workflows/";

class SmallWorkflows : public Program {
 protected:
  /// The summary of rojek2012/specimenS_modelM with `particles` of the paper's in a cylinder that many times smaller.
  Json run(const std::string& specimen, const std::string& model) const {
    const double scale = std::cbrt(300.0 / (specimen == "1" ? 10225 : 5868));
    const auto millimetres = [&](double x) { return std::to_string(scale * x) + " mm"; };
    const std::string name = "specimen" + specimen + "_model" + model;
    const Result r =
        call("run '" + workflows + "rojek2012/" + name + ".yaml' --output " + name +
             " --threads 1 --set packing.particles=300" + " --set 'packing.container.diameter=" + millimetres(23) +
             "' --set 'packing.container.height=" + millimetres(46) +
             (specimen == "2" ? "' --set 'packing.overlap_tolerance=40 %" : "") +
             "' --set protocol.max_strain=0.4% --set outputs=[] --set renderers=[]");
    EXPECT_EQ(r.code, 0) << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / name / "summary.json")) : Json();
  }
};

TEST_F(SmallWorkflows, Rojek2012) {
  for (const std::string specimen : {"1", "2"}) {
    std::map<std::string, Json> of;
    for (const std::string model : {"1", "2", "3a", "3b", "3c"}) of[model] = run(specimen, model);
    if (HasFailure()) return;
    const auto modulus = [&](const std::string& model) { return of[model]["youngs_modulus_Pa"].get<double>(); };
    const auto stiffness = [&](const std::string& model) {
      return of[model]["elastic_brittle"]["normal_stiffness_N_m"].get<double>();
    };
    // The same particles in all five; a harmonic mean is below an arithmetic one; with uniform parameters the modulus
    // is proportional to the stiffness of the bonds, as long as none breaks.
    for (const auto& [model, summary] : of) {
      EXPECT_EQ(summary["statistics"], of["1"]["statistics"]) << specimen << model;
      EXPECT_GT(summary["poisson_ratio"], 0) << specimen << model;
    }
    EXPECT_GT(modulus("1"), modulus("2")) << specimen;
    ASSERT_EQ(of["3a"]["bonds_broken_shear"], 0);
    ASSERT_EQ(of["3b"]["bonds_broken_shear"], 0);
    EXPECT_NEAR(modulus("3a") / modulus("3b"), stiffness("3a") / stiffness("3b"), 0.03) << specimen;
    const auto mean = [&](const std::string& quantity, const std::string& key) {
      return of["1"]["statistics"][quantity][key].get<double>();
    };
    EXPECT_NEAR(stiffness("3a"), 2 * 10e9 * mean("particle_radius", "mean_m"), 1e-6 * stiffness("3a"));
    EXPECT_NEAR(stiffness("3b"), 2 * 10e9 * mean("pair_arithmetic_mean_radius", "mean_m"), 1e-6 * stiffness("3b"));
    EXPECT_NEAR(stiffness("3c"), 2 * 10e9 * mean("pair_harmonic_mean_radius", "mean_m"), 1e-6 * stiffness("3c"));
    EXPECT_NEAR(of["3c"]["elastic_brittle"]["bond_shear_strength_N"].get<double>(),
                4 * 40e6 * mean("pair_minimum_radius_squared", "mean_m2"), 1e-6 * 40e6);
  }
}

/// The workflow's own `small` variant.
class SmallOuyang : public Program {
 protected:
  Json run(const std::string& name, const std::string& more = "") const {
    const Result r = call("run '" + workflows + "ouyang2017/" + name + ".yaml' --variant small --output " + name +
                          " --threads 1 " + more);
    EXPECT_EQ(r.code, 0) << name << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / name / "summary.json")) : Json();
  }
};

TEST_F(SmallOuyang, CompressionAndTensionOfFiveSpecimens) {
  std::vector<double> strengths;
  for (const char* specimen : {"a", "b", "c", "d", "e"}) {
    const std::string name = std::string("baseline_") + specimen;
    const Json c = run(name + "_ucs"), t = run(name + "_tension");
    if (HasFailure()) return;
    const auto value = [](const Json& s, const char* key) { return s[key].get<double>(); };
    EXPECT_TRUE(c["peak_reached"].get<bool>() && t["peak_reached"].get<bool>()) << name;
    // What the law is made for, and nothing that depends on one packing of a hundred discs.
    EXPECT_GT(value(c, "peak_stress_Pa"), 3 * value(t, "peak_stress_Pa")) << name;
    EXPECT_GT(value(t, "youngs_modulus_Pa"), 5e9) << name << ": tension is positive to `sense: tension`";
    EXPECT_GT(value(c, "youngs_modulus_Pa"), 5e9) << name;
    EXPECT_GT(t["direct_tension"]["protected_bonds"], 0);
    strengths.push_back(value(t, "peak_stress_Pa"));
  }
  std::sort(strengths.begin(), strengths.end());
  EXPECT_EQ(std::unique(strengths.begin(), strengths.end()), strengths.end()) << "five different specimens";
}

TEST_F(SmallOuyang, RocksAndOtherTests) {
  for (const char* rock : {"lac_du_bonnet", "quartzite"}) {
    const Json c = run(std::string(rock) + "_ucs"), t = run(std::string(rock) + "_tension");
    if (HasFailure()) return;
    EXPECT_GT(c["peak_stress_Pa"].get<double>(), 3 * t["peak_stress_Pa"].get<double>()) << rock;
  }
  const Json biaxial = run("baseline_biaxial");
  const Json brazilian = run("baseline_brazilian");
  if (HasFailure()) return;
  EXPECT_NEAR(biaxial["biaxial_compression"]["confining_pressure_applied_Pa"].get<double>(), 20e6, 0.2e6);
  EXPECT_GT(brazilian["brazilian"]["peak_tensile_stress_Pa"].get<double>(), 1e6);
}

/// The variant `inferred` has both parts in both tests, bonds that are softer than those of two of the largest discs,
/// and suits the biaxial test.
TEST_F(SmallOuyang, TheInferredReading) {
  const std::string small = " --set 'packing.container.size=[12 mm, 12 mm]' --set outputs=[] --set renderers=[]";
  for (const char* test : {"baseline_b_ucs", "baseline_b_tension"}) {
    const Json printed = run(test);
    const Result r = call("run '" + workflows + "ouyang2017/" + test + ".yaml' --variant inferred --output inferred_" +
                          test + " --threads 1" + small);
    ASSERT_EQ(r.code, 0) << r.text;
    const Json inferred = Json::parse(content(folder_ / ("inferred_" + std::string(test)) / "summary.json"));
    if (HasFailure()) return;
    EXPECT_EQ(printed["elastic_constants"]["secant"]["of"], "stress");
    EXPECT_EQ(inferred["elastic_constants"]["secant"]["of"], "strain");
    EXPECT_EQ(inferred["elastic_constants"]["sense"], printed["elastic_constants"]["sense"]);
    EXPECT_FALSE(inferred["nonlinear_tension"].contains("normal_stiffness_N")) << "no one k_n";
    EXPECT_LT(inferred["youngs_modulus_Pa"].get<double>(), 0.8 * printed["youngs_modulus_Pa"].get<double>()) << test;
    EXPECT_LT(inferred["peak_stress_Pa"].get<double>(), printed["peak_stress_Pa"].get<double>()) << test;
  }
  const Result r = call("validate '" + workflows + "ouyang2017/baseline_biaxial.yaml' --variant inferred");
  EXPECT_EQ(r.code, 0) << r.text;
}

TEST_F(SmallOuyang, Spheres) {
  const Json c = run("baseline_3d_ucs"), t = run("baseline_3d_tension");
  if (HasFailure()) return;
  EXPECT_GT(c["peak_stress_Pa"].get<double>(), 3 * t["peak_stress_Pa"].get<double>());
}

/// As the workflow's own comment has it.
TEST_F(Program, TheBeamOfBeamBondsBendsSwingsAndBreaksAsItShould) {
  const auto run = [&](const std::string& more) {
    const Result r = call("run '" + workflows + "laws/beam_bond.yaml' --output beam --overwrite --threads 1 " + more +
                          " --set outputs=[] --set renderers=[]");
    EXPECT_EQ(r.code, 0) << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / "beam/summary.json"))["end_load"] : Json();
  };
  constexpr double pi = 3.14159265358979, r = 1e-3, L = 40e-3, E = 30e9, G = E / 2.4, I = pi / 4 * r * r * r * r,
                   A = pi * r * r, F = 3;
  const Json bent = run("");
  if (HasFailure()) return;
  EXPECT_EQ(bent["stopped_by"], "rest");
  const double known = F * L * L * L / (48 * E * I) + F * L / (4 * 0.9 * G * A);
  // The chain turns by a hundredth: that its ends do not come nearer by what it bends is of the square of this.
  EXPECT_NEAR(bent["middle_load_displacement_x_m"].get<double>(), known, 2e-4 * known);
  const Json broken = run("--variant failure");
  if (HasFailure()) return;
  EXPECT_EQ(broken["stopped_by"], "max_displacement");
  // F L/4 = 60 MPa I/r; the load still grows while the beam follows.
  EXPECT_NEAR(6 * broken["load_factor_at_first_break"].get<double>(), 4 * 60e6 * I / r / L, 0.02 * 4.7);
  EXPECT_EQ(run("--variant vibration")["stopped_by"], "duration");
  EXPECT_EQ(run("--variant small")["stopped_by"], "rest");
}

}  // namespace
}  // namespace breccia::testing
