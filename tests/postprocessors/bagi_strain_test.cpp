// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "fake_view.hpp"

namespace breccia::test {
namespace {

enum class Kind { random, lattice, random_2d, lattice_2d };

FakeSimulation assembly(Kind kind) {
  FakeSimulation s;
  s.dimension = kind == Kind::random || kind == Kind::lattice ? 3 : 2;
  const bool flat = s.dimension == 2;
  if (kind == Kind::random || kind == Kind::random_2d) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> u(0, 1);
    for (int k = 0; k < 1000; ++k) {
      const double x = u(random), y = u(random), z = u(random), r = 0.03 + 0.04 * u(random);
      s.add_particle(1e-2 * Vec3(x, y, flat ? 0.0 : 2 * z), 1e-2 * r);
    }
  } else {
    for (int c = 0; c < (flat ? 1 : 8); ++c)
      for (int b = 0; b < 8; ++b)
        for (int a = 0; a < 8; ++a) s.add_particle(1e-3 * Vec3(a, b, c), 0.5e-3);
  }
  s.specimen.volume = 1e-6;
  s.specimen.axis = flat ? Vec3::UnitY() : Vec3::UnitZ();
  return s;
}

void deform(FakeSimulation& s, const Mat3& gradient) {
  for (std::size_t k = 0; k < s.position.size(); ++k)
    s.position[k] = s.reference[k] + gradient * s.reference[k] + Vec3(1e-3, -2e-3, s.dimension == 3 ? 5e-4 : 0.0);
}

class AffineDeformation : public testing::TestWithParam<Kind> {};

TEST_P(AffineDeformation, IsRecovered) {
  FakeSimulation s = assembly(GetParam());
  Mat3 g;  // stretch, shear and rotation together
  g << -1e-3, 4e-4, 2e-4, -3e-4, 5e-4, 7e-4, 9e-4, -6e-4, -2e-3;
  if (s.dimension == 2) g.row(2).setZero();
  if (s.dimension == 2) g.col(2).setZero();
  LoadedPostprocessor p("bagi_strain");
  p.begin(s.view());
  p->start_of_loading(s.view());
  deform(s, g);
  p.sample(s.view());
  const Mat3 e = 0.5 * (g + g.transpose());
  EXPECT_NEAR(p.curves.last("strain_xx"), e(0, 0), 1e-12);
  EXPECT_NEAR(p.curves.last("strain_yy"), e(1, 1), 1e-12);
  EXPECT_NEAR(p.curves.last("strain_zz"), e(2, 2), 1e-12);
  EXPECT_NEAR(p.curves.last("strain_xy"), e(0, 1), 1e-12);
  EXPECT_NEAR(p.curves.last("strain_yz"), e(1, 2), 1e-12);
  EXPECT_NEAR(p.curves.last("strain_zx"), e(2, 0), 1e-12);
  const double axial = s.dimension == 3 ? -e(2, 2) : -e(1, 1);
  EXPECT_NEAR(p.curves.last("axial_strain"), axial, 1e-12);
  EXPECT_NEAR(p.curves.last("volumetric_strain"), -e.trace(), 1e-12);
  EXPECT_NEAR(p.curves.last("lateral_strain"), (s.dimension == 3 ? 0.5 : 1.0) * (e.trace() + axial), 1e-12);
  for (const double v : p.field(s.view(), "axial_strain_local")) EXPECT_NEAR(v, axial, 1e-10);
  for (const double v : p.field(s.view(), "volumetric_strain_local")) EXPECT_NEAR(v, -e.trace(), 1e-10);
}

TEST_P(AffineDeformation, RotationEntersInSecondOrder) {
  FakeSimulation s = assembly(GetParam());
  LoadedPostprocessor p("bagi_strain");
  p.begin(s.view());
  for (const double angle : {1e-2, 1e-3}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    deform(s, turn - Mat3::Identity());
    p.sample(s.view());
    EXPECT_NEAR(p.curves.last("strain_xx"), std::cos(angle) - 1, 1e-12);
    EXPECT_NEAR(p.curves.last("strain_xy"), 0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(BagiStrain, AffineDeformation,
                         testing::Values(Kind::random, Kind::lattice, Kind::random_2d, Kind::lattice_2d));

/// Divergence theorem on a lattice: the mean gradient is the flux of the displacement through the faces of the cube.
TEST(BagiStrain, OfUnevenDisplacementIsTheBoundaryFlux) {
  FakeSimulation s = assembly(Kind::lattice);
  LoadedPostprocessor p("bagi_strain");
  p.begin(s.view());
  const double side = 7e-3;
  // u_z = -z^2/2 [m] on the lattice: the same on each end face, linear between layers.
  for (std::size_t k = 0; k < s.position.size(); ++k) {
    const double z = s.reference[k].z();
    s.position[k].z() -= 0.5 * z * z;
  }
  p.sample(s.view());
  EXPECT_NEAR(p.curves.last("axial_strain"), 0.5 * side, 1e-12);
  EXPECT_NEAR(p.curves.last("lateral_strain"), 0, 1e-12);
  // Around a particle of layer k the slope is that between layers k - 1 and k + 1, and so about -z.
  const auto local = p.field(s.view(), "axial_strain_local");
  for (std::size_t k = 0; k < local.size(); ++k) EXPECT_NEAR(local[k], s.reference[k].z(), 0.5e-3 + 1e-12);
}

TEST(BagiStrain, CountsFromTheStartOfLoading) {
  FakeSimulation s = assembly(Kind::lattice);
  LoadedPostprocessor p("bagi_strain");
  p.begin(s.view());
  deform(s, -0.01 * Mat3::Identity());
  p.sample(s.view());
  EXPECT_NEAR(p.curves.last("volumetric_strain"), 0.03, 1e-12);
  s.reference = s.position;
  p->start_of_loading(s.view());
  p.sample(s.view());
  EXPECT_EQ(p.curves.last("volumetric_strain"), 0);
}

TEST(BagiStrain, TellsWhatItLeftOut) {
  const FakeSimulation s = assembly(Kind::lattice);
  LoadedPostprocessor p("bagi_strain");
  p.begin(s.view());
  FakeSummary summary = p.finish(s.view());
  EXPECT_EQ(summary.owned.at("hidden_particles"), 0);
  EXPECT_EQ(summary.owned.at("outline_simplices_left_out"), 0);
  EXPECT_EQ(summary.owned.at("boundary_particles"), 8 * 8 * 8 - 6 * 6 * 6);
  EXPECT_NEAR(summary.owned.at("triangulated_volume_m3").get<double>(), std::pow(7e-3, 3), 1e-18);
  EXPECT_TRUE(p.host.warnings.empty());
}

TEST(BagiStrain, WarnsOfLoosePackings) {
  FakeSimulation s = assembly(Kind::random);
  for (double& r : s.radius) r *= 0.2;
  LoadedPostprocessor p("bagi_strain", {{"hull_gap", 4.0}});
  p.begin(s.view());
  EXPECT_EQ(p.host.warnings.size(), 1u);
}

}  // namespace
}  // namespace breccia::test
