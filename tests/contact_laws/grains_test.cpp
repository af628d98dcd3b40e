// SPDX-License-Identifier: BSD-3-Clause
// Grains without bonds: linear springs, dashpots, rolling resistance, each where its solution is known.
#include <gtest/gtest.h>

#include <numbers>

#include "held_pair.hpp"
#include "several.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3, pi = std::numbers::pi;

Json by_modulus(double friction) {
  return {{"contact_modulus", 20e9}, {"stiffness_ratio", 2.5}, {"friction", friction}};
}
Json by_stiffness(double normal, double shear, double friction) {
  return {{"normal_stiffness", normal}, {"shear_stiffness", shear}, {"friction", friction}};
}

TEST(Linear, PressesAndSlidesAsItsBarDoes) {
  for (const int dimension : {2, 3})
    for (const double gap : {0.0, -2e-5}) {  // a packing's overlap is free of force
      PairSetup setup;
      setup.bonded = false;
      setup.dimension = dimension;
      setup.thickness = 0.02;
      setup.radius_i = 1e-3;
      setup.radius_j = 1.5e-3;
      setup.gap = gap;
      HeldPair p(make_law(by_modulus(0.4), "linear"), setup);
      EXPECT_EQ(p.force(), Vec3::Zero());
      const double section = dimension == 2 ? 2 * 1e-3 * 0.02 : pi * 1e-6, kn = 20e9 * section / 2.5e-3, u = 1e-6;
      p.lead(-u, 0);
      EXPECT_NEAR(p.normal_force() / (-kn * u), 1, 1e-9);
      p.lead(-u, 0.5e-6);
      EXPECT_NEAR(p.shear_force() / (kn / 2.5 * 0.5e-6), 1, 1e-6) << "it sticks";
      p.lead(-u, 4e-6, 1000);
      EXPECT_NEAR(p.shear_force() / (0.4 * kn * u), 1, 1e-9) << "it slides";
      // mu k_n u over the way less that of the spring, mu k_n u/k_s = u.
      EXPECT_NEAR(p.energy().friction / (0.4 * kn * u * (4e-6 - u)), 1, 1e-6);
      p.lead(1e-6, 4e-6);
      EXPECT_EQ(p.force(), Vec3::Zero()) << "no tension";
      EXPECT_NEAR(p.unaccounted(), 0, 1e-3 * p.energy().friction);
    }
}

/// The two grains in series, each 4 E r, of discs 2 E t (Potyondy, Cundall 2004).
TEST(Linear, TakesTheModulusOfItsGrains) {
  for (const int dimension : {2, 3}) {
    PairSetup setup;
    setup.bonded = false;
    setup.dimension = dimension;
    setup.thickness = 0.02;
    setup.radius_i = 1e-3;
    setup.radius_j = 1.5e-3;
    Json config = by_modulus(0.4);
    config["modulus_of"] = "grains";
    HeldPair p(make_law(config, "linear"), setup);
    const auto grain = [&](double radius) { return dimension == 2 ? 2 * 20e9 * 0.02 : 4 * 20e9 * radius; };
    const double kn = 1 / (1 / grain(1e-3) + 1 / grain(1.5e-3)), u = 1e-6;
    p.lead(-u, 0);
    EXPECT_NEAR(p.normal_force() / (-kn * u), 1, 1e-9);
    p.lead(-u, 0.5e-6);
    EXPECT_NEAR(p.shear_force() / (kn / 2.5 * 0.5e-6), 1, 1e-6);
  }
}

/// Before a law that bonds: it adds to the push of a bond that is pressed, and is nothing where that is pulled.
TEST(Linear, ActsBesideABond) {
  const Several::Laws both = {
      {"linear", by_stiffness(3e6, 2e6, 0.3)},
      {"elastic_brittle", elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}})}};
  for (const double way : {-1e-6, 1e-6}) {
    Several s(two_spheres(r, r), both, 1e-9);
    ASSERT_EQ(s->state().bonds.size(), 1u);
    for (const Index id : {0, 1}) s.lead(id, Vec3::Zero());
    s.lead(1, Vec3(way, 0, 0));
    s.step();
    s.lead(1, Vec3::Zero());
    s.step();
    EXPECT_NEAR(s->state().particles.force()[s.of(0)].x(), way * (10e9 * 2 * r + (way < 0 ? 3e6 : 0)), 1e-5);
  }
}

/// What a test is led by where nothing is bonded: the contacts that `bonding` would have bonded.
TEST(Linear, HasAStiffnessThatTestsScaleWith) {
  Several s(simple_cubic(3, 3, 3, r), {{"linear", by_stiffness(3e6, 2e6, 0.3)}}, 1e-6);
  EXPECT_EQ(s->state().bonds.size(), 0u);
  const BondStiffness k = s->bond_stiffness();
  EXPECT_NEAR(k.mean_normal, 3e6, 1e-3);
  EXPECT_NEAR(k.modulus / (54 * 4 * r * r * 3e6 / (3 * std::pow(6 * r, 3))), 1, 1e-9);
  EXPECT_EQ(
      Several(simple_cubic(3, 3, 3, r), {{"linear", by_stiffness(3e6, 2e6, 0.3)}}, -1e-3)->bond_stiffness().modulus, 0)
      << "nothing is near enough";
}

/// Two spheres on a spring and a dashpot that cannot pull part when the two cancel: e = exp(-2 theta cot theta), beta =
/// cos(theta) (Schwager, Poeschel 2007, Granular Matter 9, 465-469). However the dashpot is told.
TEST(Viscous, MakesTheRestitutionOfItsShare) {
  const double least = 1e-3, mass_i = 2650 * 4.0 / 3.0 * pi * 1e-9, mass_j = 8 * mass_i,
               reduced = mass_i * mass_j / (mass_i + mass_j), kn = 20e9 * pi * least * least / 3e-3;
  for (const double beta : {0.0, 0.1, 0.5}) {
    const double theta = std::acos(beta), e = std::exp(-2 * theta / std::tan(theta));
    std::vector<double> measured;
    for (const Json& dashpot :
         {Json{{"normal_ratio", beta}, {"contact_modulus", 20e9}, {"stiffness_ratio", 1.0}},
          Json{{"normal_ratio", beta}, {"normal_stiffness", kn}, {"stiffness_ratio", 1.0}},
          Json{{"normal_damping", 2 * beta * std::sqrt(kn * reduced)}, {"stiffness_ratio", 1.0}}}) {
      EngineSettings settings;
      settings.safety = 0.002;
      Several s(two_spheres(1e-3, 2e-3, 1e-7), {{"linear", by_modulus(0)}, {"viscous", dashpot}}, 0, settings);
      const Impact i = impact(s, Vec3(1, 0, 0), Vec3(-1.0 / 8, 0, 0));
      measured.push_back((i.velocity[1] - i.velocity[0]).norm() / (1 + 1.0 / 8));
      EXPECT_GE(i.least_force, 0);
      EXPECT_NEAR(i.energy.error() / i.kinetic, 0, 1e-4);
      if (beta == 0) {
        EXPECT_NEAR(i.force / ((1 + 1.0 / 8) * std::sqrt(kn * reduced)), 1, 1e-5);
        EXPECT_NEAR(i.time / (pi * std::sqrt(reduced / kn)), 1, 2e-3) << "to a step";
      }
    }
    EXPECT_NEAR(measured[0], e, 2e-3) << beta;  // of the first order in the step
    EXPECT_NEAR(measured[1] / measured[0], 1, 1e-9);
    EXPECT_NEAR(measured[2] / measured[0], 1, 1e-9);
  }
}

TEST(Viscous, SaysWhatItsSharesReferTo) {
  const Registry registry;
  const auto said = [&](const Json& config) {
    const Issues issues = registry.check("contact_law", "viscous", config);
    return issues.empty() ? std::string() : issues[0].path + " " + issues[0].text;
  };
  EXPECT_EQ(said({{"normal_ratio", 0.1}, {"normal_stiffness", 1e6}, {"stiffness_ratio", 1.0}}), "");
  EXPECT_EQ(
      said({{"normal_ratio", 0.1}, {"stiffness_ratio", 1.0}}),
      "normal_ratio is a share of the critical damping of a stiffness: add `stiffness_modulus`, `contact_modulus` or "
      "`normal_stiffness`, as the law with the springs has it");
  EXPECT_EQ(said({{"normal_damping", 1}, {"contact_modulus", 1e9}, {"stiffness_ratio", 1.0}}),
            "contact_modulus belongs to `normal_ratio` and `shear_ratio`; constants that are given do not use it");
}

/// A sphere (a disc) rolls without sliding on a plane, a held sphere a million times as large, which a force N presses
/// it on. The moment M = mu_r r N takes its energy J w^2/2 about the point of contact, J = I + m a^2, in the angle
/// theta_m + (J w^2/2 - k theta_m^2/2)/M with theta_m = M/k, the rolling spring's; then it swings about where the
/// spring is free, and eta of the critical damping makes each swing exp(-pi eta/sqrt(1 - eta^2)) of the one before.
TEST(RollingResistance, StopsASphereWhereItsEnergyIsSpent) {
  const double mu = 0.1, push = 1, kn = 1e6, large = 1e6 * r, thickness = 2e-3;
  for (const int dimension : {3, 2})
    for (const double eta : {0.0, 0.1, 0.3}) {
      SCOPED_TRACE(std::to_string(dimension) + "D, " + std::to_string(eta));
      PackedParticles p;
      p.position = {Vec3::Zero(), Vec3(0, -(large + r), 0)};
      p.radius = {r, large};
      p.outline = SpecimenShape::Outline::box;
      const double spring = 2e-3;  // theta_m = 0.05
      const Json resists = {{"rolling_friction", mu},
                            {"twisting_friction", 0.0},
                            {"rolling_modulus", spring / (r * r * (dimension == 2 ? thickness : r))},
                            {"rolling_damping", eta}};
      EngineSettings settings;
      settings.safety = 0.1;
      Several s(p, {{"linear", by_stiffness(kn, kn, 1)}, {"rolling_resistance", resists}}, -1e-9, settings, dimension,
                thickness);
      for (const Index id : {0, 1}) s.lead(id, Vec3::Zero());
      s.lead(0, Vec3(0, -push / kn, 0));
      s->set_applied_force(s.of(0), Vec3(0, -push, 0), Vec3::Zero(), Mat3::Zero());
      s.step();
      const auto& all = s->state().particles;
      const Index sphere = s.of(0);
      const double arm = r - 0.5 * push / kn, mass = all.mass()[sphere],
                   inertia = all.inertia()[sphere] + mass * arm * arm, moment = mu * r * push, limit = moment / spring,
                   spin = std::sqrt(2 * moment * 2 / inertia);  // about two radians
      s.throw_it(0, Vec3(arm * spin, 0, 0), Vec3(0, 0, -spin));
      s->mark_start_of_loading();
      // The shear spring between the two swings, too, and much faster. Its force changes nothing of the angular
      // momentum about the point of contact: what that says of the velocity is the rolling by itself.
      std::vector<double> stops;
      double x = 0, before = 0;
      for (int k = 0; k < 200000 && stops.size() < 5; ++k) {
        s.step();
        const double v =
            (mass * arm * all.velocity()[sphere].x() - all.inertia()[sphere] * all.angular_velocity()[sphere].z()) *
            arm / inertia;
        if (v * before < 0) stops.push_back(x);
        x += v * s->time_step();
        before = v;
      }
      ASSERT_EQ(stops.size(), 5u);
      const double angle = limit + (0.5 * inertia * spin * spin - 0.5 * spring * limit * limit) / moment;
      // A dashpot acts until the rolling spring slides, and takes its part.
      EXPECT_LT(stops[0] / (arm * angle), 1.001);
      if (eta == 0) {
        EXPECT_GT(stops[0] / (arm * angle), 0.999);
        EXPECT_NEAR((stops[0] - stops[1]) / (2 * limit * arm), 1, 0.01);
      }
      const double decay = std::exp(-pi * eta / std::sqrt(1 - eta * eta));
      for (int k = 2; k < 4; ++k) EXPECT_NEAR((stops[k] - stops[k + 1]) / (stops[k - 1] - stops[k]), -decay, 0.01) << k;
      const EnergyLedger e = s->view().energy;
      EXPECT_NEAR(e.error() / e.initial, 0, 1e-3);
    }
}

/// One sphere among twelve that are held and pressed on it, turning against critically damped rolling springs that are
/// stiffer than all else: stable at the whole of the stated step. That the dashpots are in it shows at four times of
/// it.
TEST(RollingResistance, TheTimeStepHoldsForTheDashpot) {
  for (const bool too_long : {false, true}) {
    PackedParticles p;
    p.position = {Vec3::Zero()};
    for (const int u : {-1, 1})
      for (const int v : {-1, 1})
        for (const Vec3& d : {Vec3(u, v, 0), Vec3(u, 0, v), Vec3(0, u, v)})
          p.position.push_back(2 * r * d.normalized());
    p.radius.assign(p.position.size(), r);
    p.outline = SpecimenShape::Outline::box;
    EngineSettings settings;
    settings.safety = too_long ? 4 : 1;
    Several s(p,
              {{"linear", by_stiffness(1e5, 0, 0)},
               {"rolling_resistance",
                {{"rolling_friction", 1e3},
                 {"twisting_friction", 0.0},
                 {"rolling_modulus", 1e11},
                 {"rolling_damping", 1.0}}}},
              -1e-9, settings);
    for (Index id = 0; id < p.position.size(); ++id) s.lead(id, id == 0 ? Vec3(0, 0, 0) : Vec3(-1e-2 * p.position[id]));
    s.step();
    for (Index id = 1; id < p.position.size(); ++id) s.lead(id, Vec3::Zero());
    s.throw_it(0, Vec3::Zero(), Vec3(0.1, 0.2, 0.3));
    s.step(100);
    const double spin = s->state().particles.angular_velocity()[s.of(0)].norm();
    if (too_long) EXPECT_GT(spin, 1e3);
    else EXPECT_LT(spin, 0.1);
  }
}

}  // namespace
}  // namespace breccia::testing
