// SPDX-License-Identifier: BSD-3-Clause
// A simple cubic lattice of equal spheres has Young's modulus E_c and no Poisson effect (physics of models 1 and 2).
#include <gtest/gtest.h>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

class Lattice : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, Lattice, ::testing::Values("model_1", "model_2"),
                         [](const auto& model) { return std::string(model.param); });

TEST_P(Lattice, UniaxialModulusIsTheBondModulus) {
  const double r = 1e-3;
  const int n = 4, layers = 8;
  EngineSettings settings;
  settings.damping = {0.7, 0.7};
  Bench b = make_bench(simple_cubic(n, n, layers, r), elastic_brittle({{"model", GetParam()}}), 1e-9, settings);
  const auto& s = b->state();
  ASSERT_EQ(s.bonds.size(), std::size_t(2 * n * (n - 1) * layers + n * n * (layers - 1)));
  const double stiffness = 20e6;
  const auto low = b->add_wall({"low", s.specimen.base, Vec3::UnitZ(), stiffness, 0, 0});
  const auto high =
      b->add_wall({"high", s.specimen.base + s.specimen.height * Vec3::UnitZ(), -Vec3::UnitZ(), stiffness, 0, 0});
  b->prepare();
  const double strain = 1e-4, speed = 0.5 * strain * s.specimen.height / (4000 * b->time_step());
  b->set_wall_velocity(low, speed * Vec3::UnitZ());
  b->set_wall_velocity(high, -speed * Vec3::UnitZ());
  b.steps(4000);
  b->set_wall_velocity(low, Vec3::Zero());
  b->set_wall_velocity(high, Vec3::Zero());
  b.steps(6000);
  b->forces();
  const SimulationView view = b->view();
  const double area = 4 * r * r * n * n;
  EXPECT_NEAR(view.specimen.cross_section_area, area, 1e-9 * area);
  const double stress = 0.5 * (view.walls[1].force.z() - view.walls[0].force.z()) / area;
  double top = 0, bottom = 0, width = 0;
  for (std::size_t k = 0; k < view.particles.size(); ++k) {
    const Vec3 &x0 = view.particles.initial_position[k], u = view.particles.position[k] - x0;
    if (x0.z() < 1.1 * r) bottom += u.z() / (n * n);
    if (x0.z() > 2 * r * layers - 1.1 * r) top += u.z() / (n * n);
    width = std::max(width, std::abs(u.x()));
  }
  const double measured = (bottom - top) / (2 * r * (layers - 1));
  EXPECT_NEAR(stress / measured, 10e9, 1e-3 * 10e9);
  EXPECT_LT(width / (2 * r * n), 1e-3 * measured) << "no bond couples the axes";
}

}  // namespace
}  // namespace breccia::testing
