// SPDX-License-Identifier: BSD-3-Clause
/// The files of new_plugin_name.yaml, read back. What is expected is known from the workflow.
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;
using breccia::test_tools::TableFile;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const auto results = test.run("new_plugin_name.yaml");
    const TableFile frames(results / "frames.csv"), first(results / "particles_000000.csv");
    test.near("particles", double(first.rows()), 4 * 4 * 8, 0);
    for (std::size_t k = 0; k < first.rows(); ++k) {
      test.near("in the order of the packing", first.at("id", k), double(k), 0);
      test.near("radius [m]", first.at("radius_m", k), 1e-3, 1e-15);
    }
    // The packing counts along x, then y, then z; the first sphere touches the lower corner of the box. Loading begins
    // when the platens carry 0.5 MPa, by when the bonds, of 10 GPa, have given way by a share of 5e-5 of the height.
    const double seating = 5e-5 * 16e-3;
    test.near("x of the first [m]", first.at("x_m", 0), -3e-3, seating);
    test.near("z of the first [m]", first.at("z_m", 0), 1e-3, seating);
    test.near("z of the last [m]", first.at("z_m", 127), 15e-3, seating);
    // A frame when loading begins, then one each 0.05 ms as rows of the curves fall, and one at the end.
    test.holds("there are several frames", frames.rows() > 2);
    for (std::size_t f = 1; f < frames.rows(); ++f) {
      const double between = frames.at("time_s", f) - frames.at("time_s", f - 1);
      test.holds("time between frames", between > 0 && between < 1.1 * 0.05e-3);
    }
    char last[40];
    std::snprintf(last, sizeof last, "particles_%06zu.csv", frames.rows() - 1);
    const TableFile end(results / last);
    test.holds("the column has become shorter", end.at("z_m", 127) - end.at("z_m", 0) < 14e-3);
  });
}
