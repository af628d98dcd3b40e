// SPDX-License-Identifier: BSD-3-Clause
/// The picture of new_plugin_name.yaml, from the run and once more from its files.
#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;
using breccia::test_tools::TableFile;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const auto results = test.run("new_plugin_name.yaml");
    const TableFile curves(results / "curves.csv");
    const std::string svg = breccia::read_bytes(results / "new_plugin_name.svg");
    const std::size_t begin = svg.find("points=\""), end = svg.find("\"/>", begin);
    test.holds("the picture has a line", begin != svg.npos && end != svg.npos);
    test.near("a point for each row", double(std::count(svg.begin() + long(begin), svg.begin() + long(end), ',')),
              double(curves.rows()), 0);
    test.holds("the axes are named", svg.find("platen_strain") != svg.npos && svg.find("platen_stress_Pa") != svg.npos);

    const std::string again = results.string() + "_again";
    test.breccia({"render", results.string(), "--renderer", "new_plugin_name", "--output", again});
    test.holds("the same from the files", breccia::read_bytes(again + "/new_plugin_name.svg") == svg);
  });
}
