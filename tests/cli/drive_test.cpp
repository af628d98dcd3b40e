// SPDX-License-Identifier: BSD-3-Clause
// breccia drive: one contact along a path given as a file.
#include <map>
#include <numbers>

#include "program.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi;

class Drive : public Program {
 protected:
  /// Model 1 with spheres of 1 mm: K_n = 2 E_c r = 20 N/um, K_s = 5 N/um, strengths 4 sigma r^2 = 40 N and 80 N.
  static constexpr const char* brittle =
      "elastic_brittle --set 'contact_law.bond_modulus=10 GPa' --set contact_law.stiffness_ratio=4 "
      "--set 'contact_law.tensile_strength=10 MPa' --set 'contact_law.shear_strength=20 MPa' --set "
      "contact_law.friction=0.5 ";
  /// A = pi mm2 (alpha = 40 0.25/10 = 1), K_n = 10 pi N/um; tension 5 pi N at 0.5 um, nothing from 0.6 um on.
  static constexpr const char* damaging =
      "elasto_damage_plastic --set 'contact_law.youngs_modulus=20 GPa' --set contact_law.poisson_ratio=0.25 "
      "--set 'contact_law.tensile_strength=5 MPa' --set 'contact_law.shear_strength=10 MPa' "
      "--set contact_law.internal_friction=0.5 --set contact_law.friction=0.3 --set contact_law.softening_tension=0.2 "
      "--set contact_law.softening_shear=0.2 ";

  Result drive(const std::string& arguments) const { return Program::call("drive " + arguments); }

  void run(const std::string& arguments) {
    const Result r = drive(arguments + " --path path.csv -o out --overwrite");
    ASSERT_EQ(r.code, 0) << r.text;
    std::istringstream in(content(folder_ / "out/curves.csv"));
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(in, line);
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    curves_.clear();
    while (std::getline(in, line)) {
      std::size_t c = 0;
      for (std::istringstream row(line); std::getline(row, cell, ',');)
        curves_[names.at(c++)].push_back(std::stod(cell));
      ASSERT_EQ(c, names.size());
    }
  }
  double at(const std::string& name, std::size_t row) const { return curves_.at(name).at(row); }
  std::size_t rows() const { return curves_.at("step").size(); }

  void expect_refused(const std::string& arguments, const std::string& why) const {
    const Result r = drive(arguments + " -o out");
    EXPECT_EQ(r.code, 2) << r.text;
    EXPECT_NE(r.text.find(why), std::string::npos) << r.text;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << r.text;
  }

  std::map<std::string, std::vector<double>> curves_;
};

TEST_F(Drive, TheCurvesAreTheLaws) {
  write("path.csv", "normal_m,shear_m\n0,0\n1e-6,0\n-1e-6,0\n-1e-6,4e-6\n");
  run(std::string(brittle) + "--steps 50");
  ASSERT_EQ(rows(), 151u) << "the start, and 50 increments to each of three way points";
  EXPECT_EQ(at("step", 150), 150);
  EXPECT_NEAR(at("normal_force_N", 25), 10, 1e-9);
  EXPECT_NEAR(at("normal_force_N", 50), 20, 1e-9);
  EXPECT_NEAR(at("normal_force_N", 100), -20, 1e-9);
  EXPECT_NEAR(at("shear_force_N", 150), 20, 1e-9);
  EXPECT_NEAR(at("normal_force_N", 150), -20, 1e-9);
  EXPECT_NEAR(at("shear_spring_y_m", 150), 4e-6, 1e-15);
  EXPECT_NEAR(at("stored_energy_J", 150), 0.5 * 20 * 1e-6 + 0.5 * 20 * 4e-6, 1e-15);
  EXPECT_NEAR(at("energy_error_J", 150), 0, 1e-15);
  EXPECT_EQ(at("bond_state", 150), 1);
  const Json summary = Json::parse(content(folder_ / "out/summary.json"));
  EXPECT_NEAR(summary["largest_normal_force_N"].get<double>(), 20, 1e-9);
  EXPECT_EQ(summary["contact_law"]["elastic_brittle"]["model"], "model_1");
  for (const auto& entry : fs::directory_iterator(folder_ / "out")) EXPECT_NE(entry.path().extension(), ".partial");
}

TEST_F(Drive, TheResultsAreAlsoPrinted) {
  write("path.csv", "normal_m\n0\n-1e-6\n");
  const Result r = drive(std::string(brittle) + "--path path.csv -o out --steps 50");
  ASSERT_EQ(r.code, 0) << r.text;
  const auto line = [&](const std::string& title) {
    const std::size_t at = r.text.find("\n" + title);
    EXPECT_NE(at, r.text.npos) << title << "\n" << r.text;
    return at == r.text.npos ? std::string() : r.text.substr(at + 1, r.text.find('\n', at + 1) - at - 1);
  };
  const auto value = [&](const std::string& title) {
    return std::stod(line(title).substr(line(title).rfind('|') + 1));
  };
  // Pressed by 1 um at 20 N/um: 20 N, on the way 10 uJ.
  EXPECT_NEAR(value("least normal force (N)"), -20, 0.01);
  EXPECT_NEAR(value("work done on the pair (J)"), 1e-5, 1e-8);
  EXPECT_NEAR(value("energy stored (J)"), 1e-5, 1e-8);
  EXPECT_EQ(r.text.find("stopped before its end"), r.text.npos);
}

TEST_F(Drive, UnbondedSpheresOfTwoSizesAcrossAGap) {
  write("path.csv", "shear_m,normal_m\n0,-3e-6\n2e-5,-3e-6\n");
  run(std::string(brittle) + "--radius 1mm,3mm --gap '1 um' --unbonded");  // K_n = 2 E_c (2 mm) = 40 N/um
  EXPECT_EQ(at("bond_state", 0), 0);
  EXPECT_EQ(at("normal_force_N", 66), 0) << "0.99 um: not yet touching";
  EXPECT_NEAR(at("normal_force_N", 200), -80, 1e-7);
  EXPECT_NEAR(at("shear_force_N", 400), 40, 1e-7) << "friction 0.5";
  EXPECT_NEAR(at("friction_work_J", 400), 40 * 16e-6, 1e-9) << "20 um less the 4 um of the spring";
}

TEST_F(Drive, TheSpecimenAroundThePairIsAnOption) {
  write("path.csv", "normal_m\n0.25e-6\n0.54e-6\n0.7e-6\n");
  run(damaging);
  EXPECT_NEAR(at("normal_force_N", 200), 2.5 * pi, 1e-7);
  EXPECT_NEAR(at("normal_force_N", 400), 3 * pi, 1e-7) << "slow enough for the dashpot to vanish";
  EXPECT_NEAR(at("tension_damage", 400), 0.4, 1e-9);
  EXPECT_EQ(at("bond_state", 600), 2);
  EXPECT_NEAR(at("fracture_energy_J", 600), 1.5e-6 * pi, 1e-6 * 1.5e-6 * pi);
  run(std::string(damaging) + "--porosity '50 %' --coordination-number 5");  // alpha = 4
  EXPECT_NEAR(at("normal_force_N", 200), 4 * 2.5 * pi, 1e-7);
}

TEST_F(Drive, TimesMakeRates) {
  // Twice as long: twice as many increments of the same duration, and half the viscous force (Eq. 30).
  write("path.csv", "time_s,normal_m\n1e-4,1e-7\n3e-4,2e-7\n");
  run(std::string(damaging) + "--set 'material.density=3000 kg/m3' --set contact_law.contact_damping=0.5 --steps 10");
  ASSERT_EQ(rows(), 31u);
  EXPECT_NEAR(at("time_s", 30), 3e-4, 1e-12);
  const double m = 0.5 * 3000 * 4.0 / 3.0 * pi * 1e-9, kn = 1e7 * pi, dashpot = pi * 0.5 * std::sqrt(m * kn);
  EXPECT_NEAR(at("normal_force_N", 10), kn * 1e-7 + dashpot * 1e-3, 1e-7);
  EXPECT_NEAR(at("normal_force_N", 30), kn * 2e-7 + dashpot * 5e-4, 1e-7);
  // By trapezoids: half of it in the first increment, the mean of the two rates in the eleventh.
  EXPECT_NEAR(at("contact_work_J", 30), dashpot * (9.5 * 1e-8 * 1e-3 + 5e-9 * (0.75e-3 + 19 * 0.5e-3)), 1e-15);
  EXPECT_NEAR(at("energy_error_J", 30), 0, 1e-15);
}

TEST_F(Drive, BondsBendTwistAndBreak) {
  // Spheres of 1 mm, k_n = 1 MN over 2 mm; bending 50, torsion 2 0.5 50 N m/rad; the rim strains by 0.4 of a rotation.
  const std::string net =
      "nonlinear_tension --set 'contact_law.normal_stiffness=1 MN' --set contact_law.shear_stiffness_ratio=0.5 "
      "--set 'contact_law.bending_stiffness=50 N m/rad' --set contact_law.tensile_strain_limit=4e-3 "
      "--set contact_law.tension_shape=0.2 --set contact_law.bond_width=0.8 --set contact_law.shear_strain_ratio=3.5 "
      "--set contact_law.shear_strain_cap_ratio=10 --set 'contact_law.internal_friction_angle=45 deg' "
      "--set 'contact_law.friction_angle=39 deg' ";
  write("path.csv",
        "normal_m,shear_m,rotation_rad,twist_rad\n1.6e-6,2e-6,0.004,0.01\n-2e-6,2e-6,-0.004,0.01\n"
        "-2e-6,2e-6,-0.004,0.05\n-2e-6,2e-6,-0.02,0\n");
  run(net + "--steps 400");
  EXPECT_NEAR(at("normal_force_N", 400), 505.6964471, 1e-5) << "800 (1 - 1/e)";
  EXPECT_NEAR(at("shear_force_N", 400), 500, 1e-6);
  EXPECT_NEAR(at("bending_moment_N_m", 400), 0.2, 1e-9);
  EXPECT_NEAR(at("torque_N_m", 400), 0.5, 1e-9);
  EXPECT_NEAR(at("energy_error_J", 400), 0, 1e-6 * at("work_J", 400));
  EXPECT_NEAR(at("normal_force_N", 800), -1000, 1e-5);
  EXPECT_NEAR(at("bending_moment_N_m", 800), -0.2, 1e-9);
  EXPECT_NEAR(at("bending_z_rad", 800), -0.004, 1e-12);
  EXPECT_EQ(at("bond_state", 800), 1);
  EXPECT_EQ(at("bond_state", 1200), 3) << "1e-3 + 0.4 0.05 is more than 14e-3 + 1e-3";
  EXPECT_EQ(at("torque_N_m", 1200), 0);
  EXPECT_NEAR(at("shear_force_N", 1200), 500, 1e-5) << "below friction: it sticks";
  EXPECT_EQ(at("bending_moment_N_m", 1600), 0) << "no bond, no moment";
  EXPECT_NEAR(at("energy_error_J", 1600), 0, 1e-2 * at("fracture_energy_J", 1600));
  write("path.csv", "normal_m,rotation_rad\n0,0.0101\n");
  run(net + "--set dimension=2 --set 'thickness=2 m'");
  EXPECT_NEAR(at("bending_moment_N_m", 100), 2 * 50 * 0.00505, 1e-9);
  EXPECT_EQ(at("bond_state", 200), 2) << "the rim breaks in tension";
}

TEST_F(Drive, AWorkflowGivesItsLaw) {
  write("path.csv", "normal_m\n1e-6\n");
  write("flow.yaml", "name: incomplete\n");
  expect_refused("flow.yaml --path path.csv", "contact_law");
  write("two.csv", "x,y,z,radius\n0,0,0,1\n2,0,0,1\n");
  write("flow.yaml", R"(packing: {type: from_file, file: two.csv, length_unit: mm, outline: box}
material: {density: 2650 kg/m3}
bonding: {tolerance: 0.15}
contact_law: {type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa, shear_strength: 40 MPa, friction: 0.5}
protocol: {type: uniaxial_compression, platen_velocity: 0.2 m/s, platen_stiffness: 15 MN/m, max_strain: 0.5 %}
)");
  run("flow.yaml --set 'contact_law.bond_modulus=5 GPa' --radius 2mm");
  EXPECT_NEAR(at("normal_force_N", 200), 2 * 5e9 * 2e-3 * 1e-6, 1e-9);
}

TEST_F(Drive, APathIsReadStrictly) {
  const auto refused = [&](const std::string& text, const std::string& why) {
    write("path.csv", text);
    expect_refused(std::string(brittle) + "--path path.csv", why);
  };
  refused("", "path.csv:1: there is nothing in it");
  refused("normal_mm\n1\n", "path.csv:1: there is no column `normal_mm`; did you mean `normal_m`?");
  refused("0,0\n1e-6,0\n", "path.csv:1: there is no column `0`; the first line names the columns");
  refused("normal_m,normal_m\n", "path.csv:1: the column `normal_m` is there twice");
  refused("time_s\n1\n", "path.csv:1: nothing moves");
  refused("normal_m\n", "there is no way point after the start at zero");
  refused("normal_m,shear_m\n0,0\n1e-6\n", "path.csv:3: 1 value for 2 columns");
  refused("normal_m,shear_m\n1e-6,\n", "path.csv:2: `shear_m` has no value");
  refused("normal_m\n1 um\n", "path.csv:2: `1 um` is not a number");
  refused("normal_m\nnan\n", "path.csv:2: `nan` is not a number");
  refused("normal_m,time_s\n1e-6,1\n2e-6,1\n", "path.csv:3: the time must be above that of the row before");
  refused("normal_m,time_s\n1e-6,0\n", "path.csv:2: the path starts at zero displacement at time 0");
  refused("normal_m,time_s\n1e-6,1e-9\n2e-6,1e9\n", "time_s: increments");
  refused("normal_m\n-3e-3\n", "onto each other");
  expect_refused(std::string(brittle) + "--path nowhere.csv", "nowhere.csv");
}

TEST_F(Drive, OptionsAreReadStrictly) {
  write("path.csv", "normal_m\n1e-6\n");
  const std::string call = std::string(brittle) + "--path path.csv ";
  expect_refused("elastic_britle --path path.csv", "did you mean `elastic_brittle`?");
  expect_refused("nowhere.yaml --path path.csv", "nowhere.yaml");
  expect_refused("elastic_brittle --path path.csv", "contact_law.bond_modulus");
  expect_refused(call + "--set contact_law.frictoin=1", "friction");
  expect_refused(call + "--radius 1", "--radius: ");
  expect_refused(call + "--radius 1mm,1mm,1mm", "--radius: one radius for both particles, or two");
  expect_refused(call + "--gap '-2 mm'", "--gap: ");
  expect_refused(call + "--porosity 120%", "--porosity: ");
  expect_refused(call + "--steps 0", "--steps");
  expect_refused(call + "--coordination-number 0", "--coordination-number");
  write("path.csv", "twist_rad\n0.1\n");
  expect_refused(call + "--set dimension=2", "twist_rad: discs in a plane cannot twist");
}

TEST_F(Drive, ResultsAreNeverSilentlyReplaced) {
  write("path.csv", "normal_m\n1e-6\n");
  run(brittle);
  const std::string before = content(folder_ / "out/curves.csv");
  const Result r = drive(std::string(brittle) + "--path path.csv -o out --steps 3");
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.text.find("--overwrite"), std::string::npos) << r.text;
  EXPECT_EQ(content(folder_ / "out/curves.csv"), before);
  run(std::string(brittle) + "--steps 3");
  EXPECT_EQ(rows(), 4u);
}

}  // namespace
}  // namespace breccia::testing
