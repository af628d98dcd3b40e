// SPDX-License-Identifier: BSD-3-Clause
/// The test on a specimen whose answer is known: new_plugin_name.yaml. What is expected is stated by formula.
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;
using breccia::test_tools::TableFile;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const TableFile curves(test.run("new_plugin_name.yaml") / "curves.csv");
    constexpr double height = 16e-3, modulus = 10e9, closing = 2 * 0.05, ramp = 20e-6, longest_step = 1e-6;
    // Stopped at 0.1 %, the platens come to rest along a ramp: half of its time at full speed. To a step's way.
    const double strain = 0.1e-2 + closing * ramp / 2 / height;
    test.near("strain at the end", curves.last("platen_strain"), strain, closing * longest_step / height);
    // A column of bonds that has come to rest: in a cubic lattice of such bonds the modulus is theirs. The platens'
    // contacts, twice as stiff, make up for the two half bonds at the ends.
    test.near("stress at the end [Pa]", curves.last("platen_stress_Pa"), modulus * curves.last("platen_strain"),
              0.01 * modulus * strain);
  });
}
