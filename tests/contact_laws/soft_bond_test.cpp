// SPDX-License-Identifier: BSD-3-Clause
// A bond that softens: its curve in tension and bending, the energy below it, unloading, shear, what is refused.
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, modulus = 20e9, ratio = 2.5, strength = 10e6, cohesion = 20e6, energy = 60,
                 friction = 0.5, lambda = 0.8;

Json soft_bond(Json changes = Json::object()) {
  Json config = {{"bond_modulus", modulus},   {"stiffness_ratio", ratio},    {"tensile_strength", strength},
                 {"fracture_energy", energy}, {"cohesion", cohesion},        {"internal_friction_angle", 0.0},
                 {"friction", friction},      {"radius_multiplier", lambda}, {"moment_contribution", 1.0}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}

/// Grains of 1 and 1.5 mm; in a plane 3 mm thick.
struct Cement {
  explicit Cement(int dimension) : setup{true, 1e9, dimension, dimension == 2 ? 3e-3 : 1.0, 1e-3, 1.5e-3, 0} {
    const double t = setup.thickness;
    area = dimension == 2 ? 2 * radius * t : pi * radius * radius;
    bending = dimension == 2 ? 2.0 / 3.0 * std::pow(radius, 3) * t : 0.25 * pi * std::pow(radius, 4);
    torsion = dimension == 2 ? 0 : 0.5 * pi * std::pow(radius, 4);
  }
  HeldPair pair(Json changes = Json::object()) const {
    return HeldPair(make_law(soft_bond(std::move(changes)), "soft_bond"), setup);
  }
  PairSetup setup;
  double radius = lambda * 1e-3, normal = modulus / 2.5e-3, shear = normal / ratio;  // [m], [Pa/m]
  double area, bending, torsion;                                                     // [m2], [m4]
  double at_strength = strength / normal, at_end = 2 * energy / strength;            // w_c, w_f [m]
};

TEST(SoftBond, StiffnessesAreThoseOfTheDisc) {
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    const bool space = dimension == 3;
    HeldPair p = c.pair();
    const PairMotion m{2e-7, 1e-7, space ? 3e-7 : 0, space ? 1e-4 : 0, space ? 5e-5 : 0, -7e-5};
    p.lead(m);
    const Vec3 force(c.normal * c.area * m.normal, c.shear * c.area * m.shear_y, c.shear * c.area * m.shear_z);
    const Vec3 moment(c.shear * c.torsion * m.twist, c.normal * c.bending * m.bend_y, c.normal * c.bending * m.bend_z);
    EXPECT_EQ(p.history("damage"), 0);
    // To the second order in the motion: the springs follow the pair.
    EXPECT_LT((p.force() - force).norm(), 2e-4 * force.norm()) << dimension;
    EXPECT_LT((p.moment() - moment).norm(), 2e-4 * moment.norm()) << dimension;
    EXPECT_NEAR(p.unaccounted(), 0, 1e-6 * p.work()) << dimension;
  }
}

TEST(SoftBond, TensionFallsLinearlyAndTakesTheFractureEnergy) {
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    const double factor = c.at_end / c.at_strength - 1;
    const Json given[] = {Json::object(),
                          {{"fracture_energy", nullptr}, {"softening_factor", factor}},
                          {{"bond_modulus", nullptr}, {"normal_stiffness", c.normal}}};
    for (const Json& changes : given) {
      HeldPair p = c.pair(changes);
      p.lead(0.5 * c.at_strength, 0);
      EXPECT_NEAR(p.normal_force(), 0.5 * strength * c.area, 1e-9 * strength * c.area);
      p.lead(c.at_strength, 0);
      EXPECT_NEAR(p.normal_force(), strength * c.area, 1e-9 * strength * c.area);
      for (const double way : {0.25, 0.5, 0.9}) {
        p.lead(c.at_strength + way * (c.at_end - c.at_strength), 0, 200);
        EXPECT_NEAR(p.normal_force(), (1 - way) * strength * c.area, 1e-9 * strength * c.area) << way;
        EXPECT_NEAR(p.history("damage"), way, 1e-9);
        EXPECT_EQ(p.bond(), BondState::intact);
      }
      p.lead(1.001 * c.at_end, 0);
      EXPECT_EQ(p.bond(), BondState::broken_tension);
      EXPECT_EQ(p.force(), Vec3::Zero().eval());
      EXPECT_NEAR(p.work(), energy * c.area, 1e-6 * energy * c.area) << "the area below the curve";
      EXPECT_NEAR(p.energy().fracture, energy * c.area, 1e-6 * energy * c.area);
      EXPECT_NEAR(p.unaccounted(), 0, 1e-9 * p.work());
    }
  }
}

/// What has been dissipated half-way is the area between the curve and the secant: it is booked as it happens.
TEST(SoftBond, DissipatesAsItSoftensAndUnloadsToTheOrigin) {
  const Cement c(3);
  HeldPair p = c.pair();
  const double half = 0.5 * (c.at_strength + c.at_end), stress = 0.5 * strength;
  p.lead(c.at_strength, 0);
  p.lead(half, 0);
  const double dissipated = c.area * 0.5 * (strength * half - stress * c.at_strength);
  EXPECT_NEAR(p.energy().fracture, dissipated, 1e-9 * dissipated);
  p.lead(0.3 * half, 0);
  EXPECT_NEAR(p.normal_force(), 0.3 * stress * c.area, 1e-9 * stress * c.area);
  p.lead(0, 0);
  EXPECT_NEAR(p.normal_force(), 0, 1e-9 * stress * c.area);
  EXPECT_NEAR(p.energy().elastic, 0, 1e-12 * p.work());
  p.lead(-0.5 * c.at_strength, 0);
  EXPECT_NEAR(p.normal_force(), -0.5 * strength * c.area, 1e-9 * strength * c.area) << "pressure is carried whole";
  p.lead(0, 0);
  p.lead(half, 0);
  EXPECT_NEAR(p.normal_force(), stress * c.area, 1e-9 * stress * c.area);
  EXPECT_NEAR(p.energy().fracture, dissipated, 1e-9 * dissipated) << "nothing on the way there and back";
  p.lead(1.001 * c.at_end, 0, 1000);
  EXPECT_NEAR(p.energy().fracture, energy * c.area, 1e-6 * energy * c.area);
  EXPECT_NEAR(p.unaccounted(), 0, 1e-9 * p.work());
}

/// The opening at the rim counts: with beta = 1 bending takes I/(A R^2) of the energy, a quarter or, in a plane, a
/// third.
TEST(SoftBond, SoftensInBendingByTheOpeningAtTheRim) {
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    HeldPair p = c.pair();
    const double first = c.at_strength / c.radius, last = c.at_end / c.radius, peak = c.normal * c.bending * first;
    p.lead({0, 0, 0, 0, 0, first});
    EXPECT_NEAR(p.moment().z(), peak, 1e-9 * peak);
    p.lead({0, 0, 0, 0, 0, 0.5 * (first + last)});
    EXPECT_NEAR(p.moment().z(), 0.5 * peak, 1e-9 * peak);
    p.lead({0, 0, 0, 0, 0, 1.001 * last}, 1000);
    EXPECT_EQ(p.bond(), BondState::broken_tension);
    EXPECT_EQ(p.moment(), Vec3::Zero().eval());
    const double share = dimension == 2 ? 1.0 / 3 : 0.25;
    EXPECT_NEAR(p.energy().fracture, share * energy * c.area, 1e-5 * energy * c.area) << dimension;
    EXPECT_NEAR(p.unaccounted(), 0, 1e-9 * p.work());
  }
}

TEST(SoftBond, ShearsOffAtOnceAndSlidesAfterwards) {
  const double tan_phi = std::tan(0.5);
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    const double pressure = 0.5 * cohesion;
    for (const double share : {0.999, 1.001}) {
      HeldPair p = c.pair({{"internal_friction_angle", 0.5}});
      p.lead(-pressure / c.normal, 0);
      p.lead(-pressure / c.normal, share * (cohesion + tan_phi * pressure) / c.shear, 1000);
      EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : BondState::broken_shear) << dimension;
      EXPECT_NEAR(p.normal_force(), -pressure * c.area, 1e-4 * pressure * c.area) << "pressure stays";
      EXPECT_NEAR(p.unaccounted(), 0, 1e-4 * p.work());
      if (share < 1) continue;
      EXPECT_NEAR(p.shear_force(), friction * pressure * c.area, 1e-3 * pressure * c.area);
      const double fracture = p.energy().fracture;
      p.lead(-pressure / c.normal, 2 * (cohesion + tan_phi * pressure) / c.shear, 1000);
      EXPECT_NEAR(p.shear_force(), friction * pressure * c.area, 1e-3 * pressure * c.area);
      EXPECT_EQ(p.energy().fracture, fracture);
      EXPECT_GT(p.energy().friction, 0);
      EXPECT_NEAR(p.unaccounted(), 0, 1e-4 * p.work());
    }
  }
}

/// What is left of the cement carries shear with what is left of stiffness and strength.
TEST(SoftBond, SofteningWeakensShear) {
  const Cement c(3);
  const double half = 0.5 * (c.at_strength + c.at_end), left = 0.5 * c.at_strength / half;
  const double limit = 0.5 * cohesion / (left * c.shear);  // half the strength is left
  for (const double share : {0.999, 1.001}) {
    HeldPair p = c.pair();
    p.lead(half, 0, 1000);
    p.lead(half, 0.5 * limit);
    EXPECT_NEAR(p.shear_force(), 0.25 * cohesion * c.area, 1e-4 * cohesion * c.area);
    p.lead(half, share * limit, 1000);
    EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : BondState::broken_shear);
    EXPECT_NEAR(p.unaccounted(), 0, 1e-4 * p.work());
  }
}

TEST(SoftBond, IsBrittleWithoutSoftening) {
  const Cement c(3);
  for (const double share : {0.999, 1.001}) {
    HeldPair p = c.pair({{"fracture_energy", nullptr}, {"softening_factor", 0.0}});
    p.lead(share * c.at_strength, 0, 1000);
    EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : BondState::broken_tension);
    const double stored = 0.5 * strength * c.at_strength * c.area;
    EXPECT_NEAR(p.energy().fracture, share < 1 ? 0 : stored, 0.003 * stored);
    EXPECT_NEAR(p.unaccounted(), 0, 1e-9 * p.work());
  }
}

TEST(SoftBond, RefusesAFractureEnergyThatWouldSnapBack) {
  const Cement c(3);
  const double least = 0.5 * strength * c.at_strength;  // of the pair, 6.25 J/m2
  const auto says = [&](const Json& changes) -> std::string {
    const Json config = soft_bond(changes);
    Registry registry;
    for (const Issue& issue : registry.check("contact_law", "soft_bond", config)) return issue.path + ": " + issue.text;
    try {
      c.pair(changes);
    } catch (const UserError& e) { return e.what(); }
    return "";
  };
  EXPECT_EQ(says({{"fracture_energy", 1.001 * least}}), "");
  for (const Json& stiffness :
       {Json{{"bond_modulus", modulus}}, Json{{"bond_modulus", nullptr}, {"normal_stiffness", c.normal}}}) {
    Json changes = stiffness;
    changes["fracture_energy"] = 0.999 * least;
    const std::string text = says(changes);
    EXPECT_NE(text.find("fracture_energy"), std::string::npos) << text;
    EXPECT_NE(text.find("stores 6.25 J/m2 up to its strength"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace breccia::testing
