// SPDX-License-Identifier: BSD-3-Clause
/// The packing by itself: its source is part of this test. What is expected is stated by formula. Then a run with it.
#include "../new_plugin_name.cpp"

#include "breccia/test_tools/plugin_test.hpp"

using breccia::test_tools::PluginTest;

int main(int argc, char** argv) {
  return breccia::test_tools::run_tests(argc, argv, [](PluginTest& test) {
    const NewPluginName::Config config{breccia::Vec3(8e-3, 6e-3, 16e-3), 2e-3, 0.2};
    breccia::PackingRequest request;
    breccia::SilentHost nobody;
    const breccia::PackedParticles packed = NewPluginName(config).generate(request, nobody);
    test.near("spheres", double(packed.radius.size()), 4 * 3 * 8, 0);
    const double radius = 0.5 * 2e-3 * (1 - 0.2), least = 2 * radius * (1 - 1e-12);
    bool apart = true, within = true;
    for (std::size_t p = 0; p < packed.position.size(); ++p) {
      test.near("radius [m]", packed.radius[p], radius, 1e-15);
      const breccia::Vec3& x = packed.position[p];
      within = within && std::abs(x.x()) <= 4e-3 - 0.999 * radius && std::abs(x.y()) <= 3e-3 - 0.999 * radius &&
               x.z() >= 0.999 * radius && x.z() <= 16e-3 - 0.999 * radius;
      for (std::size_t q = 0; q < p; ++q) apart = apart && (x - packed.position[q]).norm() >= least;
    }
    test.holds("no two spheres overlap", apart);
    test.holds("all lie within the box", within);

    const auto again = NewPluginName(config).generate(request, nobody).position;
    test.holds("the same seed gives the same packing", again == packed.position);
    request.seed = 2;
    test.holds("another seed another one", NewPluginName(config).generate(request, nobody).position != again);

    test.run("new_plugin_name.yaml");
  });
}
