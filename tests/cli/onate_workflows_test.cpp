// SPDX-License-Identifier: BSD-3-Clause
// The workflows of Oñate et al. (2015) with specimens so small that each runs in a second: same shapes, laws and
// protocols.
#include <cmath>

#include "program.hpp"

namespace breccia::testing {
namespace {

class OnateWorkflows : public Program {
 protected:
  /// The summary of a run with 300 spheres.
  Json run(const std::string& name, const std::string& material, const std::string& ends) const {
    const bool bts = name.find("_bts") != std::string::npos;
    const double mean = material == "cement" ? (bts ? 2.11 : 2.143) : 12.65;  // [mm]
    const std::string radius =
        "{mean: " + std::to_string(mean) + " mm, standard_deviation: " + std::to_string(0.4 * mean) + " mm}";
    const Result r = call("run '" BRECCIA_SOURCE_DIR "/workflows/onate2015/" + name + ".yaml' --output '" + name +
                          "' --threads 1 --variant small --set packing.particles=300 --set 'packing.radius=" + radius +
                          "' --set '" + ends + "' --set sampling.every_steps=20 --set outputs=[] --set renderers=[]");
    EXPECT_EQ(r.code, 0) << name << "\n" << r.text;
    return r.code == 0 ? Json::parse(content(folder_ / name / "summary.json")) : Json();
  }
  static double number(const Json& summary, const std::string& section, const std::string& key) {
    return summary.at(section).at(key).get<double>();
  }
};

TEST_F(OnateWorkflows, UniaxialTestsAreAsStiffAsTheirMaterial) {
  for (const auto& [name, material, modulus] :
       {std::tuple{"cement_ucs", "cement", 3.8e9}, {"concrete_ucs", "concrete", 28e9}, {"shale_ucs", "shale", 30e9}}) {
    const Json s = run(name, material, "protocol.max_strain=0.15 %");
    if (HasFailure()) return;
    // A specimen of four spheres across is not the material: the order of size is what can be asked for.
    EXPECT_GT(s["youngs_modulus_Pa"].get<double>(), 0.6 * modulus) << name;
    EXPECT_LT(s["youngs_modulus_Pa"].get<double>(), 1.5 * modulus) << name;
  }
}

TEST_F(OnateWorkflows, TriaxialTestsReachTheirPressureAndStrain) {
  for (const auto& [name, material, pressure] : {std::tuple{"cement_triaxial_500psi", "cement", 500 * 6894.757},
                                                 {"cement_triaxial_1000psi", "cement", 1000 * 6894.757},
                                                 {"cement_triaxial_2000psi", "cement", 2000 * 6894.757},
                                                 {"cement_triaxial_4000psi", "cement", 4000 * 6894.757},
                                                 {"concrete_triaxial_4.5MPa", "concrete", 4.5e6},
                                                 {"concrete_triaxial_9MPa", "concrete", 9e6},
                                                 {"concrete_triaxial_60MPa", "concrete", 60e6}}) {
    const Json s = run(name, material, "protocol.max_strain=0.1 %");
    if (HasFailure()) return;
    EXPECT_NEAR(number(s, "triaxial_compression", "confining_pressure_applied_Pa"), pressure, 0.01 * pressure) << name;
    const Json& stages = s["triaxial_compression"]["stages"];
    ASSERT_EQ(stages.size(), 2u) << name;
    EXPECT_NEAR(stages[0]["platen_stress_Pa"].get<double>(), pressure, 0.01 * pressure) << name;
    EXPECT_NEAR(stages[1]["platen_strain"].get<double>(), 0.001, 1e-4) << name;
    EXPECT_GT(stages[1]["platen_stress_Pa"].get<double>(), pressure) << name;
  }
}

TEST_F(OnateWorkflows, CyclesTurnWhereTheyShould) {
  const Json s = run("concrete_cyclic_40MPa", "concrete",
                     "protocol.stages=[{confining_pressure: 40 MPa}, {axial_strain: 0.1 %}, {deviatoric_stress: 5 "
                     "MPa}, {axial_strain: 0.15 %}]");
  if (HasFailure()) return;
  const Json& stages = s["triaxial_compression"]["stages"];
  ASSERT_EQ(stages.size(), 4u);
  EXPECT_NEAR(stages[2]["platen_stress_Pa"].get<double>(), 45e6, 1.5e6);
  EXPECT_LT(stages[2]["platen_strain"].get<double>(), stages[1]["platen_strain"].get<double>());
  EXPECT_NEAR(stages[3]["platen_strain"].get<double>(), 0.0015, 1e-4);
}

TEST_F(OnateWorkflows, UniaxialStrainIsHeldByTheCell) {
  const Json s = run("cement_usc", "cement", "protocol.max_strain=0.3 %");
  if (HasFailure()) return;
  EXPECT_GT(number(s, "uniaxial_strain_compression", "cell_pressure_at_end_Pa"), 0.1e6);
  EXPECT_LT(number(s, "uniaxial_strain_compression", "mean_overlap_with_cell_m"), 0.01 * 12.7e-3);
}

TEST_F(OnateWorkflows, BrazilianDiscsAreMeasured) {
  for (const auto& [name, material, diameter] : {std::tuple{"cement_bts", "cement", 1.487 * 25.4e-3},
                                                 {"concrete_bts", "concrete", 0.15},
                                                 {"shale_bts", "shale", 0.15}}) {
    const Json s = run(name, material, "protocol.max_displacement=0.2 %");
    if (HasFailure()) return;
    EXPECT_NEAR(number(s, "brazilian", "diameter_m"), diameter, 0.02 * diameter) << name;
    EXPECT_GT(number(s, "brazilian", "peak_tensile_stress_Pa"), 0.05e6) << name;
  }
}

}  // namespace
}  // namespace breccia::testing
