// SPDX-License-Identifier: BSD-3-Clause
// What the law for spheres must have in common with that for discs, and what must not matter to either.
#include <gtest/gtest.h>

#include <cmath>

#include "contact_law/nonlinear_tension/exponential.hpp"
#include "contact_laws/loose_pairs.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr std::size_t pairs = 150;  // two chunks and a part of one

std::unique_ptr<ContactLaw> net() {
  return make_law({{"normal_stiffness", 30e6},
                   {"shear_stiffness_ratio", 0.5},
                   {"bending_ratio", 0.256},
                   {"tensile_strain_limit", 4e-3},
                   {"tension_shape", 0.2},
                   {"bond_width", 0.8},
                   {"shear_strain_ratio", 1.5},
                   {"shear_strain_cap_ratio", 10.0},
                   {"internal_friction_angle", 0.7},
                   {"friction_angle", 0.6}},
                  "nonlinear_tension");
}

/// Steps that break about half of the bonds, in both ways.
void walk(LoosePairs& p, bool in_plane, const Mat3& frame = Mat3::Identity()) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 40; ++k) p.wander(random, 1.2e-3, in_plane, frame);
  ASSERT_GT(p.count(BondState::intact), 10u);
  ASSERT_GT(p.count(BondState::broken_tension), 10u);
  ASSERT_GT(p.count(BondState::broken_shear), 5u);
}

TEST(NonlinearTensionInSpace, SpheresMovedInAPlaneAreDiscsToTheLastBit) {
  LoosePairs discs(net(), pairs, 2, true), spheres(net(), pairs, 3, true);
  walk(discs, true);
  walk(spheres, true);
  EXPECT_TRUE(same_bits(discs.force, spheres.force));
  EXPECT_TRUE(same_bits(discs.moment, spheres.moment));
  EXPECT_TRUE(same_bits(discs.state, spheres.state));
  EXPECT_TRUE(same_bits(discs.dissipated, spheres.dissipated));
  for (std::size_t c = 0; c < discs.history.size(); ++c)
    EXPECT_TRUE(same_bits(discs.history[c], spheres.history[c])) << c;
  for (const double torsion : spheres.history.back()) ASSERT_EQ(torsion, 0);
}

TEST(NonlinearTensionInSpace, AnyPlaneIsAsGoodAsAnother) {
  const Mat3 turn = Eigen::AngleAxisd(-1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  LoosePairs discs(net(), pairs, 2, true), spheres(net(), pairs, 3, true);
  for (ParticleMotion& p : spheres.motion) p.position = turn * p.position;
  walk(discs, true);
  walk(spheres, true, turn);
  EXPECT_TRUE(same_bits(discs.state, spheres.state));
  for (std::size_t k = 0; k < pairs; ++k) {
    const PairForce &f = discs.force[k], &g = spheres.force[k];
    ASSERT_LT((turn * Vec3(f.fx, f.fy, f.fz) - Vec3(g.fx, g.fy, g.fz)).norm(), 1e-4) << "of some 100 kN";
    ASSERT_LT((turn * discs.moment[k] - spheres.moment[k]).norm(), 1e-7);
    ASSERT_NEAR(spheres.history.back()[k], 0, 1e-12) << "torsion";
  }
}

TEST(NonlinearTensionInSpace, TheOrderOfTheTwoDoesNotMatter) {
  LoosePairs one(net(), pairs, 3, false), other(net(), pairs, 3, false, true);
  walk(one, false);
  walk(other, false);
  EXPECT_TRUE(same_bits(one.state, other.state));
  double force = 0, moment = 0, torsion = 0;
  for (std::size_t k = 0; k < pairs; ++k) {
    const PairForce &f = one.force[k], &g = other.force[k];
    const Vec3 a(f.fx, f.fy, f.fz), b(g.fx, g.fy, g.fz);
    force = std::max(force, a.norm());
    moment = std::max(moment, one.moment[k].norm());
    torsion = std::max(torsion, std::abs(one.history[6][k]));
    ASSERT_LT((a + b).norm(), 1e-6) << k;
    ASSERT_LT((one.moment[k] + other.moment[k]).norm(), 1e-9) << k;
    ASSERT_NEAR(one.history[6][k], other.history[6][k], 1e-15) << k;
  }
  EXPECT_GT(force, 1e4);
  EXPECT_GT(moment, 1);
  EXPECT_GT(torsion, 1e-3);
}

TEST(NonlinearTensionInSpace, APairHasTheSameBitsWhereverItStandsInABatch) {
  LoosePairs whole(net(), pairs, 3, false), part(net(), pairs, 3, false);
  part.batch.begin = 2 * PairBatch::chunk;  // the last 22, in lanes and a remainder of their own
  part.batch.end = part.batch.begin + 19;
  std::mt19937_64 random(7), same(7);
  for (int k = 0; k < 40; ++k) {
    whole.wander(random, 1.2e-3, false);
    part.wander(same, 1.2e-3, false);
  }
  for (std::size_t k = part.batch.begin; k < part.batch.end; ++k) {
    EXPECT_EQ(std::memcmp(&whole.force[k], &part.force[k], sizeof(PairForce)), 0) << k;
    EXPECT_EQ(std::memcmp(&whole.moment[k], &part.moment[k], sizeof(Vec3)), 0) << k;
  }
}

TEST(NonlinearTensionInSpace, TheExponentialIsThatOfTheLibrary) {
  double worst = 0;
  for (int k = 0; k <= 2000000; ++k) {
    const double z =
        k <= 1000000 ? k * 50e-6 : std::pow(10, -12 + 15 * (k - 1000000) * 1e-6);  // to 50; decades to 1000
    const double known = std::expm1(-z);
    worst = std::max(worst, known == 0 ? 0 : std::abs(nonlinear_tension::decay(z) / known - 1));
  }
  EXPECT_LT(worst, 4.5e-16) << "two units in the last place";
  EXPECT_EQ(nonlinear_tension::decay(0), 0);
  EXPECT_EQ(nonlinear_tension::decay(1e300), -1);
}

}  // namespace
}  // namespace breccia::testing
