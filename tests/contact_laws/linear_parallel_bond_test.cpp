// SPDX-License-Identifier: BSD-3-Clause
// The disc of cement between two grains: its stiffnesses, and the stresses at its rim at which it breaks.
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, modulus = 20e9, ratio = 2.5, strength = 10e6, cohesion = 15e6, lambda = 0.8;

Json parallel_bond(Json changes = Json::object()) {
  Json config = {{"bond_modulus", modulus},   {"stiffness_ratio", ratio},       {"tensile_strength", strength},
                 {"cohesion", cohesion},      {"internal_friction_angle", 0.0}, {"radius_multiplier", lambda},
                 {"moment_contribution", 1.0}};
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
    return HeldPair(make_law(parallel_bond(std::move(changes)), "linear_parallel_bond"), setup);
  }
  PairSetup setup;
  double radius = lambda * 1e-3, normal = modulus / 2.5e-3, shear = normal / ratio;  // [m], [Pa/m]
  double area, bending, torsion;                                                     // [m2], [m4]
};

TEST(LinearParallelBond, StiffnessesAreThoseOfTheDisc) {
  for (const int dimension : {2, 3}) {
    const Cement c(dimension);
    const bool space = dimension == 3;
    HeldPair p = c.pair();
    const PairMotion m{2e-7, 1e-7, space ? 3e-7 : 0, space ? 1e-4 : 0, space ? 5e-5 : 0, -7e-5};
    p.lead(m);
    ASSERT_EQ(p.bond(), BondState::intact) << dimension;
    const Vec3 force(c.normal * c.area * m.normal, c.shear * c.area * m.shear_y, c.shear * c.area * m.shear_z);
    const Vec3 moment(c.shear * c.torsion * m.twist, c.normal * c.bending * m.bend_y, c.normal * c.bending * m.bend_z);
    // To the second order in the motion: the springs follow the pair.
    EXPECT_LT((p.force() - force).norm(), 2e-4 * force.norm()) << dimension;
    EXPECT_LT((p.moment() - moment).norm(), 2e-4 * moment.norm()) << dimension;
    EXPECT_NEAR(p.unaccounted(), 0, 1e-6 * p.work()) << dimension;

    HeldPair given = c.pair({{"bond_modulus", nullptr}, {"normal_stiffness", c.normal}});
    given.lead(m);
    EXPECT_LT((given.force() - p.force()).norm(), 1e-12 * force.norm()) << "k_n given is k_n of the modulus";
  }
}

TEST(LinearParallelBond, BreaksWhereTheStressAtTheRimIsTheStrength) {
  const double tan_phi = std::tan(0.5);
  for (const int dimension : {2, 3})
    for (const double beta : {1.0, 0.3, 0.0}) {
      const Cement c(dimension);
      const double rim = beta * c.radius;
      // Motions at which the stress is the strength.
      const struct {
        const char* what;
        PairMotion limit;
        BondState as;
        bool in_plane;
      } ways[] = {
          {"tension", {strength / c.normal}, BondState::broken_tension, true},
          {"bending",
           {0.3 * strength / c.normal, 0, 0, 0, 0, 0.7 * strength / c.normal / (beta > 0 ? rim : 1e9)},
           BondState::broken_tension,
           true},
          {"bending about two axes",
           {0, 0, 0, 0, 0.6 * strength / c.normal / (beta > 0 ? rim : 1e9),
            0.8 * strength / c.normal / (beta > 0 ? rim : 1e9)},
           BondState::broken_tension,
           false},
          {"shear", {0, cohesion / c.shear}, BondState::broken_shear, true},
          {"shear under pressure",
           {-0.5 * cohesion / c.normal, (1 + 0.5 * tan_phi) * cohesion / c.shear},
           BondState::broken_shear,
           true},
          {"shear and twist",
           {0, 0.4 * cohesion / c.shear, 0, 0.6 * cohesion / c.shear / (beta > 0 ? rim : 1e9)},
           BondState::broken_shear,
           false},
      };
      for (const auto& way : ways) {
        SCOPED_TRACE(std::string(way.what) + ", beta " + std::to_string(beta) + ", " + std::to_string(dimension) + "D");
        const bool moment = way.limit.twist != 0 || way.limit.bend_z != 0;
        if ((dimension == 2 && !way.in_plane) || (beta == 0 && moment)) continue;
        for (const double share : {0.999, 1.001}) {
          HeldPair p = c.pair({{"internal_friction_angle", 0.5}, {"moment_contribution", beta}});
          const PairMotion& l = way.limit;
          p.lead({share * l.normal, share * l.shear_y, share * l.shear_z, share * l.twist, share * l.bend_y,
                  share * l.bend_z});
          EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : way.as) << share;
          EXPECT_NEAR(p.unaccounted(), 0, 1e-4 * p.work()) << share;
          if (share < 1) continue;
          EXPECT_EQ(p.force(), Vec3::Zero().eval()) << "what is broken carries nothing";
          EXPECT_EQ(p.moment(), Vec3::Zero().eval());
          EXPECT_NEAR(p.energy().fracture, p.work(), 1e-4 * p.work()) << "all that was stored";
          p.lead({-1e-6, 1e-6, 0, 0, 0, 1e-3});
          EXPECT_EQ(p.force(), Vec3::Zero().eval()) << "the grains' contact is another law";
        }
      }
    }
}

/// Without friction pressure does not help: the shear strength of 2004.
TEST(LinearParallelBond, WithoutFrictionPressureDoesNotHelp) {
  const Cement c(3);
  for (const double pressed : {0.0, -1e-6}) {
    HeldPair p = c.pair();
    p.lead(pressed, 0);
    p.lead(pressed, 0.999 * cohesion / c.shear);
    EXPECT_EQ(p.bond(), BondState::intact);
    p.lead(pressed, 1.001 * cohesion / c.shear);
    EXPECT_EQ(p.bond(), BondState::broken_shear);
  }
}

}  // namespace
}  // namespace breccia::testing
