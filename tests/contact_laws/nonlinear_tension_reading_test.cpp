// SPDX-License-Identifier: BSD-3-Clause
// Readings of the paper's tables: k_n = 1 MN x/R and k_m = 0.25 R k_n, of the bond or of the table. Particles of 1 and
// 3 mm that touch, d0 = 4 mm, so that 4 um are a strain of 1e-3; R = 3 mm, the larger. The smaller radius is 1 mm, the
// harmonic mean 2 1 3/(1 + 3) = 1.5 mm, the mean 2 mm: k_n is 1/3, 1/2 and 2/3 MN, k_m of the bond 250, 375 and 500 N
// m/rad, that of the table 750.
#include "contact_law/nonlinear_tension/config.hpp"
#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

Json config(const Json& changes) {
  Json c = {{"normal_stiffness", 1e6},   {"shear_stiffness_ratio", 0.5},   {"bending_ratio", 0.25},
            {"tension_shape", 0.2},      {"tensile_strain_limit", 4e-3},   {"bond_width", 0.8},
            {"shear_strain_ratio", 3.5}, {"shear_strain_cap_ratio", 10.0}, {"internal_friction_angle", 0.7},
            {"friction_angle", 0.6},     {"stiffness_radius", "none"},     {"bending_of", "bond"}};
  for (const auto& [key, value] : changes.items()) {
    if (value.is_null()) c.erase(key);
    else c[key] = value;
  }
  return c;
}

struct UnequalPair : HeldPair {
  UnequalPair(const Json& changes, int dimension = 2, double thickness = 1, bool exchanged = false)
      : HeldPair(make_law(config(changes), "nonlinear_tension"), setup(dimension, thickness, exchanged)) {}
  static PairSetup setup(int dimension, double thickness, bool exchanged) {
    PairSetup s;
    s.dimension = dimension;
    s.thickness = thickness;
    s.radius_i = exchanged ? 3e-3 : 1e-3;
    s.radius_j = exchanged ? 1e-3 : 3e-3;
    return s;
  }
};

const struct Choice {
  const char* name;
  double share;  // x/R
} choices[] = {{"smaller", 1.0 / 3}, {"harmonic", 0.5}, {"mean", 2.0 / 3}};

TEST(NonlinearTensionReading, StiffnessGoesWithTheRadiusChosen) {
  for (const Choice& choice : choices)
    for (const int dimension : {2, 3})
      for (const bool exchanged : {false, true}) {
        const double thickness = dimension == 2 ? 2.5 : 1, kn = 1e6 * choice.share * thickness, km = 0.25 * 3e-3 * kn;
        UnequalPair p(Json{{"stiffness_radius", choice.name}}, dimension, thickness, exchanged);
        p.lead({.normal = -4e-6});
        EXPECT_NEAR(p.normal_force(), -1e-3 * kn, 1e-9 * kn) << choice.name << dimension;
        EXPECT_NEAR(p.energy().elastic, 0.5 * 4e-3 * kn * 1e-6, 1e-12 * kn);
        p.lead({.normal = 4e-6});  // 0.2 4e-3 (1 - exp(-1.25)) = 5.707961625e-4
        EXPECT_NEAR(p.normal_force(), 5.707961625e-4 * kn, 1e-12 * kn);
        p.lead({.shear_y = 4e-6, .bend_z = 2e-3});
        EXPECT_NEAR(p.shear_force(), 0.5e-3 * kn, 1e-9 * kn);
        EXPECT_NEAR(p.moment().z(), 2e-3 * km, 1e-9 * km);
        EXPECT_NEAR(p.energy().elastic, 0.25 * 4e-3 * kn * 1e-6 + 0.5 * km * 4e-6, 1e-12 * kn);
        EXPECT_EQ(p.bond(), BondState::intact);
      }
}

TEST(NonlinearTensionReading, BendingOfTheTableIsTheSameForAll) {
  for (const Choice& choice : choices) {
    UnequalPair discs(Json{{"stiffness_radius", choice.name}, {"bending_of", "table"}}, 2, 2.5);
    discs.lead({.normal = -4e-6, .bend_z = -2e-3});
    EXPECT_NEAR(discs.moment().z(), -2e-3 * 750 * 2.5, 1e-9) << choice.name;
    EXPECT_NEAR(discs.normal_force(), -2500 * choice.share, 1e-6);
    UnequalPair spheres(Json{{"stiffness_radius", choice.name}, {"bending_of", "table"}}, 3);
    spheres.lead({.twist = 1e-3, .bend_y = 2e-3});
    EXPECT_NEAR(spheres.moment().y(), 1.5, 1e-9);
    EXPECT_NEAR(spheres.moment().x(), 0.75, 1e-9) << "k_t = 2 k_s/k_n k_m";
  }
}

/// What the limits are is not a matter of stiffness; what broke keeps the stiffness of its pressure.
TEST(NonlinearTensionReading, LimitsStayAndPressureKeepsItsStiffness) {
  for (const Choice& choice : choices) {
    UnequalPair p(Json{{"stiffness_radius", choice.name}});
    p.lead({.normal = 15.999e-6});
    EXPECT_EQ(p.bond(), BondState::intact) << choice.name;
    p.lead({.normal = 16.001e-6});
    EXPECT_EQ(p.bond(), BondState::broken_tension);
    // d0 k_n b e_n0 (e_n0 - b e_n0 (1 - exp(-5)))
    const double kn = 1e6 * choice.share, stored = 4e-3 * kn * 8e-4 * (4e-3 - 8e-4 * (1 - std::exp(-5.0)));
    EXPECT_NEAR(p.energy().fracture, stored, 1e-4 * stored);
    p.lead({.normal = -4e-6});
    EXPECT_NEAR(p.normal_force(), -1e-3 * kn, 1e-9 * kn);
  }
}

TEST(NonlinearTensionReading, TheReferenceRadiusMayBeGiven) {
  // Twice the radius: half the stiffness, and 0.25 R k_n of the bond as it was. Beside `bending_stiffness`, too.
  UnequalPair p(Json{{"stiffness_radius", "harmonic"}, {"reference_radius", 6e-3}});
  p.lead({.normal = -4e-6, .bend_z = 2e-3});
  EXPECT_NEAR(p.normal_force(), -250, 1e-6);
  EXPECT_NEAR(p.moment().z(), 0.75, 1e-9);
  UnequalPair given(Json{{"stiffness_radius", "harmonic"},
                         {"reference_radius", 6e-3},
                         {"bending_ratio", nullptr},
                         {"bending_stiffness", 40.0}});
  given.lead({.normal = -4e-6, .bend_z = 2e-3});
  EXPECT_NEAR(given.normal_force(), -250, 1e-6);
  EXPECT_NEAR(given.moment().z(), 0.08, 1e-9);
}

/// As printed: all bonds have k_n, whatever their radii, and both ways of k_m are one, to the last bit.
TEST(NonlinearTensionReading, ByDefaultAsPrinted) {
  UnequalPair silent(Json{{"stiffness_radius", nullptr}, {"bending_of", nullptr}}), none(Json::object()),
      table(Json{{"bending_of", "table"}});
  const PairMotion path[] = {{.normal = -4e-6}, {.normal = 5e-6, .shear_y = 8e-6, .bend_z = 3e-3}, {.normal = 2e-6}};
  for (const PairMotion& m : path) {
    for (UnequalPair* p : {&silent, &none, &table}) p->lead(m);
    for (UnequalPair* p : {&none, &table}) {
      EXPECT_EQ((p->force() - silent.force()).norm(), 0);
      EXPECT_EQ((p->moment() - silent.moment()).norm(), 0);
      EXPECT_EQ(p->energy().elastic, silent.energy().elastic);
    }
  }
  silent.lead({.normal = -4e-6, .bend_z = 2e-3});
  EXPECT_NEAR(silent.normal_force(), -1000, 1e-6);
  EXPECT_NEAR(silent.moment().z(), 1.5, 1e-9);
}

TEST(NonlinearTensionReading, WhatDoesNotBelongTogetherIsRefused) {
  Schema<nonlinear_tension::Config> s;
  nonlinear_tension::describe(s);
  const auto first = [&](const Json& changes) {
    const Issues issues = s.check(config(changes));
    return issues.empty() ? "" : issues[0].path + ": " + issues[0].text;
  };
  const Json modulus = {{"normal_stiffness", nullptr}, {"bond_modulus", 1e9}};
  const auto with = [](Json a, const Json& b) {
    a.update(b);
    return a;
  };
  EXPECT_EQ(first({{"stiffness_radius", "mean"}, {"bending_of", "table"}, {"reference_radius", 1e-3}}), "");
  EXPECT_EQ(first(modulus), "");
  EXPECT_EQ(first(with(modulus, {{"stiffness_radius", "harmonic"}})),
            "stiffness_radius: belongs to `normal_stiffness`: with `bond_modulus` a bond is already as stiff as the "
            "smaller particle is wide; leave one of the two out");
  EXPECT_EQ(first(with(modulus, {{"bending_of", "table"}})),
            "bending_of: `table` needs `normal_stiffness`: with `bond_modulus` there is no k_n that all bonds share; "
            "write `bond`");
  const Json stiff = {{"bending_ratio", nullptr}, {"bending_stiffness", 50.0}};
  EXPECT_EQ(first(with(stiff, {{"bending_of", "table"}})),
            "bending_of: belongs to `bending_ratio`: `bending_stiffness` is the same for all bonds anyhow");
  EXPECT_EQ(first(with(stiff, {{"reference_radius", 1e-3}})),
            "reference_radius: belongs to `bending_ratio` and `stiffness_radius`; `bending_stiffness` does not use it");
  EXPECT_EQ(first(with(stiff, {{"reference_radius", 1e-3}, {"stiffness_radius", "mean"}})), "");
}

}  // namespace
}  // namespace breccia::testing
