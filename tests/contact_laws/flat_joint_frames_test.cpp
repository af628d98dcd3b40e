// SPDX-License-Identifier: BSD-3-Clause
// Elements follow their particles: neither where a pair lies, nor how it turns as a whole, nor which comes first
// matters.
#include <gtest/gtest.h>

#include "contact_laws/loose_pairs.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

constexpr std::size_t pairs = 150;  // two chunks and a part of one

std::unique_ptr<ContactLaw> joint(const std::string& elements) {
  return make_law({{"elements", elements},
                   {"bond_modulus", 10e9},
                   {"stiffness_ratio", 2.5},
                   {"radius_multiplier", 1.0},
                   {"tensile_strength", 20e6},
                   {"cohesion", 25e6},
                   {"internal_friction_angle", 0.5},
                   {"friction", 0.5},
                   {"bonded_share", 1.0},
                   {"gapped_share", 0.0},
                   {"gap", 0.0},
                   {"lot", 0.5}},
                  "flat_joint");
}

void walk(LoosePairs& p, bool in_plane, const Mat3& frame = Mat3::Identity()) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 40; ++k) p.wander(random, 5e-4, in_plane, frame);
  std::size_t partly = 0;
  for (const double share : p.history[1]) partly += share > 0 && share < 1;
  ASSERT_GT(partly, 10u) << "some must be half broken";
  ASSERT_GT(p.count(BondState::intact), 10u);
}

Vec3 force(const LoosePairs& p, std::size_t k) { return {p.force[k].fx, p.force[k].fy, p.force[k].fz}; }
double largest(const LoosePairs& p) {
  double most = 0;
  for (std::size_t k = 0; k < pairs; ++k) most = std::max(most, force(p, k).norm());
  return most;
}

TEST(FlatJointFrames, NoDirectionOfSpaceIsPreferred) {
  const Mat3 turn = Eigen::AngleAxisd(-1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const char* elements : {"disc_1x3", "disc_1x4", "disc_2x4"}) {
    LoosePairs here(joint(elements), pairs, 3, false), there(joint(elements), pairs, 3, false);
    for (ParticleMotion& p : there.motion) p.position = turn * p.position;
    walk(here, false);
    walk(there, false, turn);
    EXPECT_TRUE(same_bits(here.state, there.state)) << elements;
    EXPECT_TRUE(same_bits(here.history[0], there.history[0])) << elements << ": the same elements hold";
    const double most = largest(here);
    for (std::size_t k = 0; k < pairs; ++k) {
      ASSERT_LT((turn * force(here, k) - force(there, k)).norm(), 1e-9 * most) << elements;
      ASSERT_LT((turn * here.moment[k] - there.moment[k]).norm(), 1e-12 * most) << elements;
    }
  }
}

TEST(FlatJointFrames, TheOrderOfTheTwoDoesNotMatter) {
  for (const auto& [elements, dimension] : {std::pair("disc_1x3", 3), {"disc_2x4", 3}, {"line_4", 2}}) {
    const bool in_plane = dimension == 2;
    LoosePairs one(joint(elements), pairs, dimension, in_plane),
        other(joint(elements), pairs, dimension, in_plane, true);
    walk(one, in_plane);
    walk(other, in_plane);
    EXPECT_TRUE(same_bits(one.state, other.state)) << elements;
    EXPECT_TRUE(same_bits(one.history[1], other.history[1])) << elements;
    const double most = largest(one);
    for (std::size_t k = 0; k < pairs; ++k) {
      ASSERT_LT((force(one, k) + force(other, k)).norm(), 1e-9 * most) << elements;
      ASSERT_LT((one.moment[k] + other.moment[k]).norm(), 1e-12 * most) << elements;
    }
  }
}

TEST(FlatJointFrames, TurningAsARigidBodyTurnsForcesAlong) {
  for (const auto& [elements, dimension] : {std::pair("disc_1x4", 3), {"disc_2x4", 3}, {"line_8", 2}}) {
    const bool in_plane = dimension == 2;
    LoosePairs p(joint(elements), pairs, dimension, in_plane);
    walk(p, in_plane);
    std::vector<Vec3> before, moment = p.moment;
    for (std::size_t k = 0; k < pairs; ++k) before.push_back(force(p, k));
    const std::vector<double> held = p.history[0];
    const Vec3 axis = in_plane ? Vec3::UnitZ() : Vec3(1, -2, 0.5).normalized();
    constexpr int steps = 2000;
    const double angle = 1.5;
    const Mat3 part = Eigen::AngleAxisd(angle / steps, axis).toRotationMatrix(),
               whole = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    for (int step = 0; step < steps; ++step) {
      for (ParticleMotion& one : p.motion) {
        const Vec3 to = part * one.position;
        one.velocity = (to - one.position) / LoosePairs::dt;
        one.angular_velocity = angle / steps / LoosePairs::dt * axis;
        one.position = to;
      }
      Interactions(*p.law).evaluate(p.batch);
    }
    EXPECT_TRUE(same_bits(held, p.history[0])) << elements << ": nothing breaks";
    const double most = largest(p);
    for (std::size_t k = 0; k < pairs; ++k) {
      ASSERT_LT((whole * before[k] - force(p, k)).norm(), 1e-4 * most) << elements << " " << k;
      ASSERT_LT((whole * moment[k] - p.moment[k]).norm(), 1e-7 * most) << elements << " " << k;
    }
  }
}

}  // namespace
}  // namespace breccia::testing
