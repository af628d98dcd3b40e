// SPDX-License-Identifier: BSD-3-Clause
// Every branch of the law along paths whose forces are worked out by hand. Particles of 1 mm that touch, d0 = 2 mm: 2
// um are a strain of 1e-3. k_n = 1 MN, k_s = 0.5 MN, k_m = 50 N m/rad; b e_n0 = 8e-4; the rim of the bond is at 0.8 mm,
// so that a rotation strains it by 0.4 of itself. Forces in N, displacements in um, rotations in mrad.
#include <numbers>

#include "contact_law/nonlinear_tension/config.hpp"
#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double um = 1e-6, mrad = 1e-3, degree = std::numbers::pi / 180;

Json config(const Json& changes = Json::object()) {
  Json c = {{"normal_stiffness", 1e6},      {"shear_stiffness_ratio", 0.5},   {"bending_stiffness", 50.0},
            {"tensile_strain_limit", 4e-3}, {"tension_shape", 0.2},           {"bond_width", 0.8},
            {"shear_strain_ratio", 3.5},    {"shear_strain_cap_ratio", 10.0}, {"internal_friction_angle", 45 * degree},
            {"friction_angle", 39 * degree}};
  for (const auto& [key, value] : changes.items()) {
    if (value.is_null()) c.erase(key);
    else c[key] = value;
  }
  return c;
}

class Pair : public HeldPair {
 public:
  explicit Pair(const Json& changes = Json::object(), const PairSetup& setup = {})
      : HeldPair(make_law(config(changes), "nonlinear_tension"), setup) {}
  Pair& to(double normal, double shear, double bend = 0, double twist = 0, int n = 100) {
    return go({.normal = normal * um, .shear_y = shear * um, .twist = twist * mrad, .bend_z = bend * mrad}, n);
  }
  Pair& go(const PairMotion& m, int n = 100) {
    lead(m, n);
    return *this;
  }
  double pull() const { return normal_force(); }
  double drag() const { return shear_force(); }
  bool intact() const { return bond() == BondState::intact; }
};

constexpr double exact = 1e-6;  // N, of hundreds

TEST(NonlinearTension, TheCurvesOfFigure2) {
  const struct {
    double b, half, whole;
  } figure[] = {// F_n/(k_n e_n0) = b (1 - exp(-e/(b e_n0))) at e_n0/2, e_n0
                {0.05, 0.0499977300, 0.0499999999}, {0.1, 0.0993262053, 0.0999954600},
                {0.2, 0.1835830003, 0.1986524106},  {0.5, 0.3160602794, 0.4323323584},
                {1.0, 0.3934693403, 0.6321205588},  {1000, 0.4998750208, 0.9995001666}};
  for (const auto& f : figure) {
    Pair p(Json{{"tension_shape", f.b}});
    EXPECT_NEAR(p.to(4, 0).pull() / 4000, f.half, 1e-9) << f.b;
    EXPECT_NEAR(p.to(8 - 1e-9, 0).pull() / 4000, f.whole, 1e-9) << f.b;
    EXPECT_TRUE(p.intact());
    EXPECT_NEAR(p.to(4, 0).pull() / 4000, f.half, 1e-9) << "elastic: back along the same curve";
    EXPECT_NEAR(p.to(-4, 0).pull() / 4000, -0.5, 1e-9) << "compression is linear";
    EXPECT_NEAR(p.to(1e-3, 0).pull(), 0.5, 0.5 * (0.5e-6 / (2 * f.b * 4e-3) + 1e-6)) << "tension begins with k_n";
  }
}

TEST(NonlinearTension, PureTensionBreaksAtItsLimit) {
  Pair p;
  EXPECT_NEAR(p.to(1.6, 0).pull(), 505.6964471, exact) << "800 (1 - 1/e)";
  p.to(7.9999, 0);
  EXPECT_TRUE(p.intact());
  EXPECT_NEAR(p.unaccounted(), 0, 1e-3 * p.work()) << "100 steps, by trapezoids";
  p.to(8.0001, 0, 0, 0, 1);
  EXPECT_EQ(p.bond(), BondState::broken_tension);
  EXPECT_EQ(p.pull(), 0);
  // d0 k_n b e_n0 (e_n0 - b e_n0 (1 - exp(-5)))
  EXPECT_NEAR(p.energy().fracture, 5.1286e-3, 2e-7);
  EXPECT_EQ(p.energy().elastic, 0);
  EXPECT_EQ(p.to(4, 0).pull(), 0) << "a broken bond does not pull";
  EXPECT_NEAR(p.to(-2, 0).pull(), -1000, exact);
}

TEST(NonlinearTension, BendingStrainsTheRim) {
  Pair p;
  EXPECT_NEAR(p.to(0, 0, 4).moment().z(), 0.2, 1e-9);
  EXPECT_NEAR(p.to(0, 0, -4).moment().z(), -0.2, 1e-9);
  EXPECT_NEAR(p.energy().elastic, 0.5 * 50 * 16e-6, 1e-12);
  EXPECT_EQ(p.drag(), 0);
  const struct { double normal, bend; } limits[] = {{0, 10}, {4, 5}, {-2, 12.5}};  // e_n + 0.4 theta = 4e-3
  for (const auto& l : limits) {
    Pair q;
    EXPECT_TRUE(q.to(l.normal, 0).to(l.normal, 0, -0.9999 * l.bend).intact()) << l.normal;
    EXPECT_NEAR(q.moment().z(), -0.9999 * 50 * l.bend * mrad, 1e-9);
    EXPECT_EQ(q.to(l.normal, 0, -1.0001 * l.bend).bond(), BondState::broken_tension) << l.normal;
    EXPECT_EQ(q.moment().z(), 0);
    EXPECT_NEAR(q.pull(), l.normal < 0 ? 500 * l.normal : 0, exact) << "pressure stays";
  }
  EXPECT_EQ(Pair(Json{{"bond_width", 0.0}}).to(0, 0, 1000).bond(), BondState::intact)
      << "beams on the axis do not stretch";
}

TEST(NonlinearTension, TheSmallerParticleSetsTheWidth) {
  PairSetup setup;
  setup.radius_j = 3e-3;  // 0.8 1/4 = 0.2
  EXPECT_TRUE(Pair(Json::object(), setup).to(0, 0, 19.99).intact());
  EXPECT_EQ(Pair(Json::object(), setup).to(0, 0, 20.01).bond(), BondState::broken_tension);
}

TEST(NonlinearTension, TheShearCriterionOfFigure4) {
  const struct {
    double strain, limit;
  } figure[] = {// in 1e-3: 14 - e_n, at most 40, tension cut off at 4
                {-30, 40}, {-26, 40}, {-25, 39}, {-20, 34}, {0, 14}, {2, 12}, {3.9, 10.1}};
  for (const auto& f : figure) {
    for (const double side : {1.0, -1.0}) {
      Pair p;
      p.to(2 * f.strain, 0).to(2 * f.strain, side * 2 * 0.9999 * f.limit);
      EXPECT_TRUE(p.intact()) << f.strain;
      EXPECT_NEAR(p.drag(), side * 500 * 0.9999 * f.limit, exact);
      p.to(2 * f.strain, side * 2 * 1.0001 * f.limit);
      EXPECT_EQ(p.bond(), BondState::broken_shear) << f.strain;
    }
  }
  EXPECT_EQ(Pair().to(0, 2 * 9).to(8.001, 2 * 9).bond(), BondState::broken_tension);
  EXPECT_EQ(Pair().to(-20, 2 * 20).to(0, 2 * 20).bond(), BondState::broken_shear) << "the pressure goes";
  // Both limits passed in one step: tension.
  EXPECT_EQ(Pair().to(7, 20).to(9, 50, 0, 0, 1).bond(), BondState::broken_tension);
}

TEST(NonlinearTension, FrictionAfterShearFailure) {
  Pair p;
  p.to(-2, 0).to(-2, 29.99);  // limit 14e-3 + 1e-3
  EXPECT_NEAR(p.drag(), 0.5e6 * 29.99e-6 / 2e-3, exact);
  p.to(-2, 30.01, 0, 0, 4);
  EXPECT_EQ(p.bond(), BondState::broken_shear);
  EXPECT_NEAR(p.pull(), -1000, exact) << "breaking in shear leaves the pressure";
  EXPECT_NEAR(p.drag(), 809.784033, exact) << "tan(39 deg) 1000 N";
  // Half k_s e_s^2 d0 at the limit, less that at the friction limit: 112.5 mJ - 1.3115 mJ.
  EXPECT_NEAR(p.energy().fracture + p.energy().friction, 111.1885e-3, 1e-4 * 111e-3);
  const double before = p.energy().friction;
  p.to(-2, 40);
  EXPECT_NEAR(p.energy().friction - before, 809.784033 * 9.99e-6, 1e-9);
  EXPECT_NEAR(p.to(-2, 39).drag(), 809.784033 - 250, exact) << "the spring goes back: sticking";
  EXPECT_NEAR(p.to(-4, 60).drag(), 2 * 809.784033, exact);
  EXPECT_EQ(p.to(1, 60).drag(), 0);
  EXPECT_EQ(p.moment().norm(), 0);
}

TEST(NonlinearTension, NeverBondedPairsOnlyPressAndRub) {
  Pair p(Json::object(), {.bonded = false});
  EXPECT_EQ(p.to(2, 0, 5, 5).pull(), 0);
  EXPECT_EQ(p.moment().norm(), 0);
  p.to(-2, 0, 0, 0);
  EXPECT_NEAR(p.to(-2, 50, 5, 5).pull(), -1000, exact);
  EXPECT_NEAR(p.drag(), 809.784033, exact);
  EXPECT_EQ(p.moment().norm(), 0);
  EXPECT_EQ(p.history("bending_z"), 0) << "nothing is remembered for a bond that is not there";
  EXPECT_EQ(p.bond(), BondState::unbonded);
}

TEST(NonlinearTension, BreakingReleasesNoStoredOverlap) {
  Pair across(Json::object(), {.gap = 4e-6});  // d0 = 2.004 mm, afterwards 2 mm
  EXPECT_NEAR(across.to(-3, 0).pull(), -1e6 * 3 / 2004, exact);
  EXPECT_EQ(across.to(-3, 40).bond(), BondState::broken_shear);
  EXPECT_EQ(across.pull(), 0) << "not touching yet";
  EXPECT_NEAR(across.to(-6, 40).pull(), -1000, exact) << "2 um of 2 mm";
  EXPECT_NEAR(across.unaccounted(), 0, 0.02 * across.work());

  Pair overlapping(Json::object(), {.gap = -4e-6});  // d0 = 1.996 mm all along
  EXPECT_EQ(overlapping.pull(), 0);
  EXPECT_NEAR(overlapping.to(-2, 0).pull(), -1e6 * 2 / 1996, exact);
  EXPECT_EQ(overlapping.to(-2, 40).bond(), BondState::broken_shear);
  EXPECT_NEAR(overlapping.pull(), -1e6 * 2 / 1996, exact);
  EXPECT_EQ(overlapping.to(0.001, 40).pull(), 0);
}

TEST(NonlinearTension, SpheresBendAboutTwoAxes) {
  Pair p;
  p.go({.bend_y = 5.99e-3, .bend_z = -7.99e-3});  // norm just below 10 mrad
  EXPECT_TRUE(p.intact());
  EXPECT_NEAR((p.moment() - Vec3(0, 50 * 5.99e-3, -50 * 7.99e-3)).norm(), 0, 1e-9);
  EXPECT_EQ(p.go({.bend_y = 6.01e-3, .bend_z = -8.01e-3}).bond(), BondState::broken_tension);
}

TEST(NonlinearTension, TorsionShearsTheRim) {
  Pair p;
  EXPECT_NEAR(p.to(0, 0, 0, 10).moment().x(), 0.5, 1e-9) << "k_t = 2 k_s/k_n k_m = 50";
  EXPECT_NEAR(p.history("torsion"), 10 * mrad, 1e-12);
  EXPECT_NEAR(p.energy().elastic, 0.5 * 50 * 1e-4, 1e-12);
  EXPECT_NEAR(Pair(Json{{"torsion_ratio", 0.3}}).to(0, 0, 0, 10).moment().x(), 0.15, 1e-9);
  const struct { double normal, shear, twist; } limits[] = {{0, 0, 35}, {0, 8, 25}, {-2, 0, 37.5}};  // e_s + 0.4 twist
  for (const auto& l : limits) {
    Pair q;
    EXPECT_TRUE(q.to(l.normal, l.shear).to(l.normal, l.shear, 0, -0.9999 * l.twist).intact()) << l.twist;
    EXPECT_EQ(q.to(l.normal, l.shear, 0, -1.0001 * l.twist).bond(), BondState::broken_shear) << l.twist;
    EXPECT_EQ(q.moment().norm(), 0);
  }
}

TEST(NonlinearTension, StiffnessesFollowFromTheModulusAndTheReferenceRadius) {
  const Json bars = {
      {"normal_stiffness", nullptr}, {"bond_modulus", 1e9}, {"bending_stiffness", nullptr}, {"bending_ratio", 0.25}};
  PairSetup setup;
  setup.radius_j = 2e-3;
  Pair spheres(bars, setup);
  spheres.to(-3, 0, 1);
  EXPECT_NEAR(spheres.pull(), -4, 1e-9) << "1 GPa (2 mm)^2 = 4 kN";
  EXPECT_NEAR(spheres.moment().z(), 2e-3, 1e-12) << "0.25 4 kN 2 mm: the largest radius";
  setup.dimension = 2;
  setup.thickness = 0.5;
  Pair discs(bars, setup);
  discs.to(-3, 0, 1);
  EXPECT_NEAR(discs.pull(), -1000, exact) << "1 GPa 2 mm 0.5 m = 1 MN";
  EXPECT_NEAR(discs.moment().z(), 0.5, 1e-9);
  Json other = bars;
  other["reference_radius"] = 1e-3;
  EXPECT_NEAR(Pair(other, setup).to(-3, 0, 1).moment().z(), 0.25, 1e-9);
}

TEST(NonlinearTension, ForcesAndEnergiesOfDiscsAreThoseOfTheThickness) {
  PairSetup setup;
  setup.dimension = 2;
  Pair one(Json::object(), setup);
  setup.thickness = 2.5;
  Pair more(Json::object(), setup);
  const double path[][3] = {{3, 4, 2}, {-5, 10, -7}, {-5, 40, -7}, {-3, 10, 0}, {1, 0, 0}};
  for (const auto& [normal, shear, bend] : path) {
    one.to(normal, shear, bend);
    more.to(normal, shear, bend);
    EXPECT_EQ(one.bond(), more.bond());
    EXPECT_NEAR((more.force() - 2.5 * one.force()).norm(), 0, exact);
    EXPECT_NEAR((more.moment() - 2.5 * one.moment()).norm(), 0, 1e-9);
  }
  EXPECT_EQ(one.bond(), BondState::broken_shear);
  EXPECT_NEAR(more.energy().fracture, 2.5 * one.energy().fracture, 1e-9);
  EXPECT_NEAR(more.energy().friction, 2.5 * one.energy().friction, 1e-9);
}

TEST(NonlinearTension, TheWorkIsInTheLedger) {
  // Without breakage the error is that of the trapezoidal rule: four times the steps, a sixteenth of it.
  const auto elastic = [](int n) {
    Pair p;
    p.to(3, 5, 4, 10, n).to(-10, -8, -9, -20, n).to(5, 2, 1, 3, n);
    EXPECT_TRUE(p.intact());
    return std::abs(p.unaccounted()) / p.energy().elastic;
  };
  const double coarse = elastic(250), fine = elastic(1000);
  EXPECT_LT(fine, 1e-5);
  EXPECT_NEAR(fine, coarse / 16, 0.02 * coarse);

  std::mt19937_64 random(5);
  const auto uniform = [&] { return 2 * (double(random() >> 11) * 0x1p-53) - 1; };
  double fracture = 0, friction = 0;
  for (int walk = 0; walk < 5; ++walk) {
    Pair p;
    for (int k = 0; k < 8; ++k)
      p.go({10 * um * (uniform() - 0.5), 40 * um * uniform(), 40 * um * uniform(), 30 * mrad * uniform(),
            3 * mrad * uniform(), 3 * mrad * uniform()},
           4000);
    EXPECT_FALSE(p.intact());
    EXPECT_LT(std::abs(p.unaccounted()), 1e-3 * (p.energy().fracture + p.energy().friction));
    fracture += p.energy().fracture;
    friction += p.energy().friction;
  }
  EXPECT_GT(fracture, 1e-3);
  EXPECT_GT(friction, 1e-3) << "the walks must rub";
}

TEST(NonlinearTension, WhatAWorkflowMayNotSay) {
  Schema<nonlinear_tension::Config> s;
  nonlinear_tension::describe(s);
  EXPECT_TRUE(s.check(config()).empty());
  const auto first = [&](const Json& changes) {
    const Issues issues = s.check(config(changes));
    return issues.empty() ? "" : issues[0].path;
  };
  EXPECT_EQ(first({{"reference_radius", 1e-3}}), "reference_radius");
  EXPECT_EQ(first({{"shear_strain_cap_ratio", 3.0}}), "shear_strain_cap_ratio");
  EXPECT_EQ(first({{"shear_strain_cap_ratio", 3.5}}), "");
}

}  // namespace
}  // namespace breccia::testing
