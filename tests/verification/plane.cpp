// SPDX-License-Identifier: BSD-3-Clause
// Two dimensions are the same engine with motion held in a plane.
#include <gtest/gtest.h>

#include <numbers>

#include "support/support.hpp"

namespace breccia::testing {
namespace {

void crush_discs(const Json& law, const std::string& name) {
  PackedParticles p = random_block(8, 12, 1, 1e-3, 21);
  for (Vec3& x : p.position) x.z() = 0;
  p.axis = Vec3::UnitY();
  Bench b = make_bench(p, law, 0.15, {}, 2, name);
  const Particles& q = b->state().particles;
  EXPECT_NEAR(q.mass()[0], 2650 * std::numbers::pi * q.radius()[0] * q.radius()[0], 1e-12 * q.mass()[0])
      << "thickness 1 m";
  EXPECT_NEAR(q.inertia()[0], 0.5 * q.mass()[0] * q.radius()[0] * q.radius()[0], 1e-12 * q.inertia()[0]);
  b->prepare();
  for (Index k = 0; k < q.size(); ++k) {
    b->hold(k, dof::x | dof::y | dof::rz, Vec3(2, q.position()[k].y() > 12e-3 ? -1 : 1, 0), Vec3(0, 0, 100));
    b->release(k, dof::all);  // the plane is not let go of
    EXPECT_EQ(q.held[k], dof::out_of_plane);
  }
  b.steps(2000);
  std::size_t broken = 0;
  for (const BondState s : b->state().bonds.state) broken += is_broken(s);
  EXPECT_GT(broken, 5u) << "the test must break something";
  for (Index k = 0; k < q.size(); ++k) {
    ASSERT_EQ(q.position()[k].z(), 0);
    ASSERT_EQ(q.angular_velocity()[k].x(), 0);
    ASSERT_EQ(q.angular_velocity()[k].y(), 0);
  }
}

TEST(Plane, DiscsBreakAndStayInTheirPlane) {
  crush_discs(elastic_brittle({{"tensile_strength", 4e6}, {"shear_strength", 4e6}}), "elastic_brittle");
  crush_discs(nonlinear_tension({{"tensile_strain_limit", 5e-4}}), "nonlinear_tension");
}

}  // namespace
}  // namespace breccia::testing
