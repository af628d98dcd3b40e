// SPDX-License-Identifier: BSD-3-Clause
/// The measure on a specimen whose answer is known: new_plugin_name.yaml. What is expected is stated by formula.
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;
using breccia::test_tools::TableFile;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const TableFile curves(test.run("new_plugin_name.yaml") / "curves.csv");
    // Stretched along z alone: of the bonds, 2 mm long, a third are along z and take the strain; the others keep their
    // length. Strain is positive in compression.
    constexpr double length = 2e-3, rounding = 1e-15;
    test.near("at the start [m]", curves.at("mean_bond_elongation_m", 0), 0, length * 1e-6);
    for (std::size_t row = 0; row < curves.rows(); ++row)
      test.near("elongation [m]", curves.at("mean_bond_elongation_m", row),
                -curves.at("axial_strain", row) * length / 3, rounding);
    test.near("strain at the end", curves.last("axial_strain"), -0.1e-2, 0.01e-2);
  });
}
