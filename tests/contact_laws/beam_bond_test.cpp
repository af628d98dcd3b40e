// SPDX-License-Identifier: BSD-3-Clause
// One Timoshenko beam between two particles: its end forces and moments against the textbook's stiffness matrix, the
// stresses at its ends at which it breaks.
#include <numbers>

#include "contact_laws/held_pair.hpp"

namespace breccia::testing {
namespace {

constexpr double pi = std::numbers::pi, modulus = 20e9, shear_modulus = 8e9, tension = 10e6, compression = 40e6,
                 shear_limit = 15e6, lambda = 0.8;

Json beam_bond(Json changes = Json::object()) {
  Json config = {{"bond_modulus", modulus},     {"shear_modulus", shear_modulus},      {"radius_multiplier", lambda},
                 {"tensile_strength", tension}, {"compressive_strength", compression}, {"shear_strength", shear_limit}};
  for (const auto& [key, value] : changes.items()) config[key] = value;
  return config;
}

/// Between particles of these radii that touch; in a plane 3 mm thick.
struct Beam {
  Beam(int dimension, double ri, double rj, double gap = 0)
      : setup{true, 1e9, dimension, dimension == 2 ? 3e-3 : 1.0, ri, rj, gap},
        length(ri + rj + gap),
        radius(lambda * std::min(ri, rj)) {
    const double t = setup.thickness, kappa = dimension == 2 ? 5.0 / 6.0 : 0.9;
    area = dimension == 2 ? 2 * radius * t : pi * radius * radius;
    bending = dimension == 2 ? 2.0 / 3.0 * std::pow(radius, 3) * t : 0.25 * pi * std::pow(radius, 4);
    torsion = dimension == 2 ? 0 : 0.5 * pi * std::pow(radius, 4);
    peak_of_shear = dimension == 2 ? 1.5 : 4.0 / 3.0;
    phi = 12 * modulus * bending / (kappa * shear_modulus * area * length * length);
  }
  HeldPair pair(Json changes = Json::object()) const {
    return HeldPair(make_law(beam_bond(std::move(changes)), "beam_bond"), setup);
  }
  PairSetup setup;
  double length, radius, area, bending, torsion, peak_of_shear, phi;
};

/// The centres stay where they are and the ends turn by these angles about z [rad]: shear force on the first particle
/// along y, end moments on the two about z.
struct EndLoads {
  double shear, moment_i, moment_j;
};
EndLoads textbook(const Beam& b, double turn_i, double turn_j) {
  const double k = modulus * b.bending / (b.length * b.length * b.length * (1 + b.phi)), L = b.length;
  // Rows of the stiffness matrix for the slopes; what the beam does to its ends has the other sign.
  return {-6 * L * k * (turn_i + turn_j), -k * L * L * ((4 + b.phi) * turn_i + (2 - b.phi) * turn_j),
          -k * L * L * ((2 - b.phi) * turn_i + (4 + b.phi) * turn_j)};
}

/// The second particle turned less the first, and what the contact point slips, for those turns.
PairMotion motion(const Beam& b, double turn_i, double turn_j) {
  const double ai = b.setup.radius_i + 0.5 * b.setup.gap, aj = b.setup.radius_j + 0.5 * b.setup.gap;
  return {0, -(ai * turn_i + aj * turn_j), 0, 0, 0, turn_j - turn_i};
}

TEST(BeamBond, EndForcesAndMomentsAreTheTextbooks) {
  for (const int dimension : {2, 3})
    for (const auto& [ri, rj] : {std::pair(1e-3, 1e-3), {1e-3, 1.7e-3}, {1.6e-3, 1e-3}})
      for (const double gap : {0.0, 0.5e-3})
        for (const auto& [ti, tj] : {std::pair(1e-5, 1e-5), {1e-5, -1e-5}, {2e-5, 0.0}, {0.0, 1e-5}}) {
          const Beam b(dimension, ri, rj, gap);
          HeldPair p = b.pair();
          p.lead(motion(b, ti, tj));
          ASSERT_EQ(p.bond(), BondState::intact);
          const EndLoads known = textbook(b, ti, tj);
          // The engine turns each particle by the shear force times the way from its centre to the contact point.
          const double ai = ri + 0.5 * gap, aj = rj + 0.5 * gap, shear = p.force().y(), moment = p.moment().z();
          const double size = std::abs(known.moment_i) + std::abs(known.moment_j);
          EXPECT_NEAR(shear, known.shear, 1e-4 * size / b.length);
          EXPECT_NEAR(moment + ai * shear, known.moment_i, 1e-4 * size);
          EXPECT_NEAR(-moment + aj * shear, known.moment_j, 1e-4 * size);
          EXPECT_NEAR(p.unaccounted(), 0, 1e-6 * p.work());
        }
}

TEST(BeamBond, StretchAndTwistAreThoseOfABar) {
  const Beam b(3, 1e-3, 1.5e-3);
  HeldPair p = b.pair();
  p.lead({1e-7, 0, 0, 1e-5});
  EXPECT_NEAR(p.force().x(), modulus * b.area / b.length * 1e-7, 1e-4 * p.force().x());
  EXPECT_NEAR(p.moment().x(), shear_modulus * b.torsion / b.length * 1e-5, 1e-4 * p.moment().x());
}

TEST(BeamBond, BreaksByTheStressesAtItsEnds) {
  for (const int dimension : {2, 3})
    for (const double rj : {1e-3, 1.6e-3}) {
      const Beam b(dimension, 1e-3, rj);
      // One end turns: the larger end moment is there.
      const double turn = tension * b.bending / b.radius / std::abs(textbook(b, 1, 0).moment_i);
      PairMotion bent = motion(b, turn, 0), pressed = motion(b, 0.5 * turn, 0);
      pressed.normal = -(compression - 0.5 * tension) / modulus * b.length;
      const struct {
        const char* what;
        PairMotion limit;
        BondState as;
        bool in_plane;
      } ways[] = {
          {"tension", {tension / modulus * b.length}, BondState::broken_tension, true},
          {"compression", {-compression / modulus * b.length}, BondState::broken_combined, true},
          {"bending", bent, BondState::broken_tension, true},
          {"bending under pressure", pressed, BondState::broken_combined, true},
          {"twist", {0, 0, 0, shear_limit / b.radius * b.length / shear_modulus}, BondState::broken_shear, false}};
      for (const auto& way : ways) {
        if (dimension == 2 && !way.in_plane) continue;
        for (const double share : {0.998, 1.002}) {
          HeldPair p = b.pair();
          const PairMotion& l = way.limit;
          p.lead({share * l.normal, share * l.shear_y, 0, share * l.twist, 0, share * l.bend_z});
          EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : way.as) << way.what << share << dimension << rj;
          EXPECT_NEAR(p.unaccounted(), 0, 1e-3 * p.work()) << way.what;
          if (share > 1) {
            EXPECT_EQ(p.force(), Vec3::Zero().eval()) << "what is broken carries nothing";
            EXPECT_EQ(p.moment(), Vec3::Zero().eval());
          }
        }
      }
    }
}

/// So thick a beam breaks by bending first, unless it is made strong against that.
TEST(BeamBond, BreaksInShear) {
  for (const int dimension : {2, 3}) {
    const Beam b(dimension, 1e-3, 1.6e-3);
    const double turn = shear_limit * b.area / b.peak_of_shear / std::abs(textbook(b, 1, 1).shear);
    for (const double share : {0.998, 1.002}) {
      HeldPair p = b.pair({{"tensile_strength", 1e12}, {"compressive_strength", 1e12}});
      p.lead(motion(b, share * turn, share * turn));
      EXPECT_EQ(p.bond(), share < 1 ? BondState::intact : BondState::broken_shear) << share << dimension;
    }
  }
}

}  // namespace
}  // namespace breccia::testing
