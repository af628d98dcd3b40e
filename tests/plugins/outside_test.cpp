// SPDX-License-Identifier: BSD-3-Clause
/// The example of docs/writing_a_law.md: a project outside the tree, built with nothing but find_package(Breccia), once
/// against the build folder and once against an installation; then loaded and used. Its physics has its own test; that
/// the page shows it as it is, tests/docs.
#include <cmath>

#include "fixture.hpp"
#include "pair_rig.hpp"
#include "plugin/registry.hpp"

namespace breccia::test {

static const fs::path example = fs::path(BRECCIA_SOURCE_DIR) / "docs/examples/hertz";

/// Builds the example and returns the folder where the plugin lies.
static fs::path build_example(const Folder& folder, const fs::path& package) {
  const fs::path source = folder / "source", build = folder / "build", log = folder / "log";
  fs::copy(example, source, fs::copy_options::recursive);
  const std::string cmake = "'" BRECCIA_CMAKE "'";
  run(cmake + " -S '" + source.string() + "' -B '" + build.string() + "' -G '" BRECCIA_GENERATOR "'" +
          " -DCMAKE_CXX_COMPILER='" BRECCIA_CXX_COMPILER "' -DCMAKE_PREFIX_PATH='" + package.string() + "'",
      log);
  run(cmake + " --build '" + build.string() + "'", log);
  return build;
}

class Outside : public ::testing::TestWithParam<const char*> {};

TEST_P(Outside, BuildsAndLoads) {
  const Folder folder;
  fs::path package = BRECCIA_BINARY_DIR;
  if (GetParam() == std::string("installed")) {
    package = folder / "prefix";
    run("'" BRECCIA_CMAKE "' --install '" BRECCIA_BINARY_DIR "' --component sdk --prefix '" + package.string() + "'",
        folder / "log");
  }
  const fs::path lies = build_example(folder, package);
  const Environment path("BRECCIA_PLUGIN_PATH", lies.string());
  const Registry registry;
  EXPECT_EQ(registry.info("contact_law", "my_hertz").version, "1.0");
  PairRig rig(registry.create<ContactLaw>(
      {"my_hertz", {{"youngs_modulus", 1e9}, {"poisson_ratio", 0}, {"friction", 0.5}, {"design_overlap", 0.01}}}));
  rig.step(1e-6, 0);
  // Hertz with E* = E/2 and R* = 1.2 mm: 4/3 E* sqrt(R*) u^(3/2).
  EXPECT_NEAR(rig.force.fx, -4.0 / 3.0 * 0.5e9 * std::sqrt(1.2e-3) * 1e-9, 1e-9 * -rig.force.fx);
}
INSTANTIATE_TEST_SUITE_P(Against, Outside, ::testing::Values("build_folder", "installed"),
                         [](const auto& p) { return std::string(p.param); });

}  // namespace breccia::test
