// SPDX-License-Identifier: BSD-3-Clause
/// The physics of the documentation's example law.
#include <cmath>

#include "fixture.hpp"
#include "pair_rig.hpp"
#include "plugin/registry.hpp"

namespace breccia::test {

static constexpr double youngs = 50e9, poisson = 0.25, friction = 0.3;

static std::unique_ptr<ContactLaw> make_law() {
  Registry registry((std::vector<PluginFolder>()));
  registry.add(fs::path(BRECCIA_FIXTURES) / "example_law.so");
  return registry.create<ContactLaw>(
      {"my_hertz",
       {{"youngs_modulus", youngs}, {"poisson_ratio", poisson}, {"friction", friction}, {"design_overlap", 0.01}}});
}

class MyHertz : public ::testing::Test, protected PairRig {
 protected:
  MyHertz() : PairRig(make_law()) {}
};

TEST_F(MyHertz, NormalForceIsHertzs) {
  for (const double overlap : {1e-8, 1e-6, 5e-5}) {
    step(overlap, 0);
    // Johnson (1985), Eq. 4.23 solved for the load, from both spheres' compliances.
    const double compliance = 2 * (1 - poisson * poisson) / youngs, curvature = 1 / r1 + 1 / r2;
    EXPECT_NEAR(force.fx, -4.0 / 3.0 / compliance * std::pow(overlap, 1.5) / std::sqrt(curvature), 1e-9 * -force.fx);
    EXPECT_EQ(force.fy, 0);
  }
  step(-1e-6, 0);
  EXPECT_EQ(force.fx, 0);
}

TEST_F(MyHertz, EnergyIsTheWorkOfTheNormalForce) {
  constexpr int n = 20000;
  constexpr double deepest = 2e-5;
  double work = 0, before = 0;
  for (int k = 1; k <= n; ++k) {
    step(deepest * k / n, 0);
    work += 0.5 * (before - force.fx) * deepest / n;
    before = -force.fx;
  }
  EXPECT_NEAR(energy(), work, 1e-6 * work);
}

TEST_F(MyHertz, ShearStiffnessOverNormalStiffnessIsMindlins) {
  constexpr double overlap = 1e-5, small = 1e-10;
  step(overlap, 0);
  const double f0 = force.fx;
  step(overlap, small);
  const double ks = force.fy / small;
  history[0] = history[1] = history[2] = 0;
  step(overlap * (1 + 1e-6), 0);
  const double kn = (f0 - force.fx) / (overlap * 1e-6);
  // Mindlin (1949): k_s/k_n = 2 (1 - nu)/(2 - nu) for equal materials.
  EXPECT_NEAR(ks / kn, 2 * (1 - poisson) / (2 - poisson), 1e-5);
}

TEST_F(MyHertz, ShearIsLimitedByFrictionAndItsWorkIsAccountedFor) {
  constexpr double overlap = 1e-5, slip = 1e-9;
  step(overlap, 0);
  const double normal_energy = energy();
  double work = 0, before = 0;
  for (int k = 0; k < 20000; ++k) {
    step(overlap, slip);
    work += 0.5 * (before + force.fy) * slip;
    before = force.fy;
  }
  EXPECT_NEAR(force.fy, friction * -force.fx, 1e-12 * force.fy);
  EXPECT_GT(dissipated.friction, 0);
  EXPECT_NEAR(energy() - normal_energy + dissipated.friction, work, 1e-3 * work);
}

TEST_F(MyHertz, NoEnergyComesFromLoadingAndUnloadingAShearedContact) {
  // Shear while deep, unload to half: the spring may shed energy, never gain it; the account closes exactly.
  step(2e-5, 0);
  const double normal_deep = energy();
  step(2e-5, 2e-7);
  const double shear_energy = energy() - normal_deep;
  const double sheared = force.fy;
  step(1e-5, 0);
  EXPECT_NEAR(force.fy / sheared, std::sqrt(0.5), 1e-12);
  const double left = energy();
  history[1] = 0;
  const double shear_left = left - energy();
  EXPECT_GT(dissipated.contact, 0);
  EXPECT_NEAR(shear_left + dissipated.contact, shear_energy, 1e-9 * shear_energy);
}

TEST_F(MyHertz, TheTimeStepSeesContactsThatAreToCome) {
  ContactStiffness apart, touching;
  motion[1].position = Vec3(r1 + r2 + 1e-6, 0, 0);
  Interactions(*law).stiffness(batch, &apart);
  motion[1].position = Vec3(r1 + r2 - 0.02 * r1 * r2 / (r1 + r2), 0, 0);
  Interactions(*law).stiffness(batch, &touching);
  EXPECT_NEAR(touching.normal / apart.normal, std::sqrt(2.0), 1e-9);  // twice the design overlap
}

}  // namespace breccia::test
