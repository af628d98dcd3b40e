// SPDX-License-Identifier: BSD-3-Clause
/// Calibrates new_plugin_name.yaml: a cubic lattice is as stiff as its bonds are, in proportion.
#include "breccia/param_spec.hpp"
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const auto results = test.calibrate("new_plugin_name.yaml");
    const breccia::Json found = breccia::Json::parse(breccia::read_bytes(results / "calibration.json"));
    test.near("as stiff as was wanted", found["targets"]["stiffness"]["measured"].get<double>(), 8e9, 0.02 * 8e9);
    test.near("by bonds as stiff", found["parameters"]["modulus"]["best"].get<double>(), 8e9, 0.1 * 8e9);
  });
}
