// SPDX-License-Identifier: BSD-3-Clause
/// One pair of spheres led along paths (`breccia drive`), and the specimen of new_plugin_name.yaml. What is expected is
/// stated by formula, from the equations of README.md.
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;
using breccia::test_tools::TableFile;

constexpr double modulus = 10e9, ratio = 4, strength = 40e6, friction = 0.5;  // as given below
constexpr double radius = 1e-3, broad = 2 * radius, kn = modulus * broad, ks = kn / ratio;
const std::vector<std::string> law = {"--set",    "contact_law.bond_modulus=10 GPa",
                                      "--set",    "contact_law.stiffness_ratio=4",
                                      "--set",    "contact_law.tensile_strength=40 MPa",
                                      "--set",    "contact_law.friction=0.5",
                                      "--radius", "1 mm",
                                      "--steps",  "100"};

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    // Pulled, pressed, then sheared. Each row of the path is a way point, each takes 100 increments.
    const TableFile bonded = test.drive("new_plugin_name", "normal_m,shear_m\n1e-6,0\n-1e-6,0\n-1e-6,2e-6\n", law);
    test.near("normal force, pulled [N]", bonded.at("normal_force_N", 100), kn * 1e-6, 1e-9 * kn * 1e-6);
    test.near("normal force, pressed [N]", bonded.at("normal_force_N", 200), -kn * 1e-6, 1e-9 * kn * 1e-6);
    test.near("shear force [N]", bonded.at("shear_force_N", 300), ks * 2e-6, 1e-9 * ks * 2e-6);
    test.near("stored [J]", bonded.at("stored_energy_J", 300), 0.5 * kn * 1e-12 + 0.5 * ks * 4e-12, 1e-15);
    test.near("the bond holds", bonded.at("bond_state", 300), 1, 0);

    // Pulled apart by 10.05 um: the bond breaks in the increment in which it reaches its strength.
    const double limit = strength * broad * broad, stretch = limit / kn, increment = 10.05e-6 / 100;
    const TableFile broken = test.drive("new_plugin_name", "normal_m\n10.05e-6\n", law);
    double most = 0;
    for (const double force : broken.column("normal_force_N")) most = force > most ? force : most;
    test.near("largest force [N]", most, limit, kn * increment);
    test.near("broken in tension", broken.at("bond_state", 100), 2, 0);
    test.near("fracture energy [J]", broken.at("fracture_energy_J", 100), 0.5 * limit * stretch, limit * increment);
    test.near("energy that is missing [J]", broken.at("energy_error_J", 100), 0, 1e-6 * limit * stretch);

    // Without a bond: pressed, then sheared until it slides.
    std::vector<std::string> unbonded = law;
    unbonded.push_back("--unbonded");
    const double slides_at = friction * kn * 1e-6;
    const TableFile sliding = test.drive("new_plugin_name", "normal_m,shear_m\n-1e-6,0\n-1e-6,2e-5\n", unbonded);
    test.near("friction [N]", sliding.at("shear_force_N", 200), slides_at, 1e-9 * slides_at);
    test.near("dissipated by sliding [J]", sliding.at("friction_work_J", 200), slides_at * (2e-5 - slides_at / ks),
              1e-6 * slides_at * 2e-5);

    // The whole specimen: a cubic lattice of such bonds has the bar's modulus.
    const TableFile curves(test.run("new_plugin_name.yaml") / "curves.csv");
    test.near("energy that is missing, over the work done", curves.last("energy_error_J"), 0,
              1e-3 * curves.last("energy_boundary_work_J"));
  });
}
