// SPDX-License-Identifier: BSD-3-Clause
// The Brazilian test: the stress that it reports follows from the load and the size measured from the particles.
#include <numbers>

#include "protocols/protocol_run.hpp"

namespace breccia::testing {
namespace {

PackedParticles disc(int across, int layers, double r) {
  PackedParticles block = simple_cubic(across, across, layers, r), p;
  for (std::size_t k = 0; k < block.position.size(); ++k)
    if (std::hypot(block.position[k].x() - across * r, block.position[k].y() - across * r) <= (across - 0.9) * r) {
      p.position.push_back(block.position[k]);
      p.radius.push_back(r);
      if (layers == 1) p.position.back().z() = 0;
    }
  p.outline = layers == 1 ? SpecimenShape::Outline::ellipsoid : SpecimenShape::Outline::cylinder;
  p.axis = layers == 1 ? Vec3::UnitY() : Vec3::UnitZ();
  return p;
}

TEST(Brazilian, StressFollowsFromLoadAndMeasuredSize) {
  for (const int dimension : {3, 2}) {
    const double scale = dimension == 3 ? 1 : 1000;  // discs are 1 m thick
    ProtocolRun run(
        disc(11, dimension == 3 ? 4 : 1, 1e-3),
        elastic_brittle(
            {{"tensile_strength", scale * 2e6}, {"shear_strength", scale * 40e6}, {"bond_modulus", scale * 10e9}}),
        "elastic_brittle", 1e-6, "brazilian", {{"platen_velocity", 0.05}, {"max_displacement", 0.02}}, dimension);
    run.go(400000);
    const double diameter = run.summary.at("diameter_m").get<double>(),
                 thickness = run.summary.at("thickness_m").get<double>();
    EXPECT_NEAR(diameter, 22e-3, 1e-9);
    EXPECT_NEAR(thickness, dimension == 3 ? 8e-3 : 1.0, 1e-9);
    EXPECT_NEAR(run.rows.last("tensile_stress"), 2 * run.rows.last("load") / (std::numbers::pi * diameter * thickness),
                1e-6 * std::abs(run.rows.last("tensile_stress")) + 1e-9);
    EXPECT_GT(run.summary.at("peak_tensile_stress_Pa").get<double>(), 0.1e6) << dimension;
  }
}

// The outermost row of such a disc is a single particle, of so many layers so many.
TEST(Brazilian, SaysHowManyParticlesCarryThePeak) {
  for (const int layers : {1, 4}) {
    const double scale = layers == 1 ? 1000 : 1;
    ProtocolRun run(
        disc(11, layers, 1e-3),
        elastic_brittle(
            {{"tensile_strength", scale * 2e6}, {"shear_strength", scale * 40e6}, {"bond_modulus", scale * 10e9}}),
        "elastic_brittle", 1e-6, "brazilian", {{"platen_velocity", 0.05}, {"max_displacement", 0.02}},
        layers == 1 ? 2 : 3);
    run.go(400000);
    EXPECT_EQ(run.summary.at("platen_particles_at_peak").get<double>(), layers);
  }
}

TEST(Brazilian, RefusesLoadsAlongTheAxisAndOtherShapes) {
  EXPECT_THROW(ProtocolRun(disc(7, 3, 1e-3), elastic_brittle(), "elastic_brittle", 1e-6, "brazilian",
                           {{"platen_velocity", 0.1}, {"axis", "z"}}),
               UserError);
  EXPECT_THROW(ProtocolRun(simple_cubic(4, 4, 4, 1e-3), elastic_brittle(), "elastic_brittle", 1e-6, "brazilian",
                           {{"platen_velocity", 0.1}}),
               UserError);
}

}  // namespace
}  // namespace breccia::testing
