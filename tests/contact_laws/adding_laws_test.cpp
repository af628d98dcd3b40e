// SPDX-License-Identifier: BSD-3-Clause
// Laws of a list add up on each pair: each with its own history and account, later ones with the normal force so far.
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "several.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

PackedParticles two(double distance = 2 * r) {
  PackedParticles p;
  p.position = {Vec3::Zero(), Vec3(distance, 0, 0)};
  p.radius = {r, r};
  p.outline = SpecimenShape::Outline::box;
  return p;
}

const std::pair<std::string, Json> springs = {"elastic_brittle",
                                              elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}})};
std::pair<std::string, Json> dashpot(double normal, double shear = 0) {
  return {"viscous",
          {{"normal_ratio", normal}, {"shear_ratio", shear}, {"stiffness_modulus", 10e9}, {"stiffness_ratio", 1.0}}};
}
std::pair<std::string, Json> rolling(double friction, double twisting = 0) {
  return {"rolling_resistance",
          {{"rolling_friction", friction}, {"twisting_friction", twisting}, {"rolling_modulus", 10e9}}};
}

TEST(AddingLaws, OneAtMostMakesBonds) {
  const auto a = make_law(), b = make_law(nonlinear_tension(), "nonlinear_tension");
  try {
    Interactions({{a.get(), "elastic_brittle"}, {b.get(), "nonlinear_tension"}});
    FAIL();
  } catch (const UserError& e) {
    EXPECT_STREQ(e.what(),
                 "contact_law: `elastic_brittle` and `nonlinear_tension` both make bonds: of a list of laws one may, "
                 "the others add to it");
  }
}

/// The logarithmic decrement of a bonded pair that swings: 2 pi beta/sqrt(1 - beta^2) a period.
TEST(AddingLaws, ADashpotDampsItsShareOfTheCritical) {
  for (const double beta : {0.05, 0.2}) {
    EngineSettings settings;
    settings.safety = 0.02;
    Several s(two(), {springs, dashpot(beta)}, 1e-9, settings);
    s->forces();
    s->mark_start_of_loading();
    for (const Index k : {0, 1}) {
      s->hold(k, dof::all, Vec3(k == 0 ? -0.1 : 0.1, 0, 0), Vec3::Zero());
      s->release(k, dof::all);
    }
    const double start = s->view().energy.kinetic, stiffness = 10e9 * 2 * r,
                 mass = 0.5 * s->state().particles.mass()[0], omega = std::sqrt(stiffness / mass),
                 period = 2 * std::numbers::pi / (omega * std::sqrt(1 - beta * beta));
    while (s->time() < 2 * period) {
      s->advance();
      s->forces();
    }
    const EnergyLedger e = s->view().energy;
    EXPECT_NEAR(
        std::log(start / (e.kinetic + e.elastic)) / 2 / (2 * 2 * std::numbers::pi * beta / std::sqrt(1 - beta * beta)),
        1, 0.03)
        << beta;
    EXPECT_NEAR(e.error(), 0, 2e-3 * start) << beta;
    EXPECT_GT(e.contact, 0.3 * start);
  }
}

/// Neither bonded nor pressed: nothing. Pressed and parting fast: it may take the push away, and not pull.
TEST(AddingLaws, ADashpotCannotPullWhatIsNotBonded) {
  Several apart(two(2.1 * r), {springs, dashpot(0.9)}, 1e-9);
  for (const Index k : {0, 1}) apart->hold(k, dof::all, Vec3(k == 0 ? -1 : 1, 0, 0), Vec3::Zero());
  apart->forces();
  EXPECT_EQ(apart->state().particles.force()[0], Vec3::Zero());

  // Not bonded, for the tolerance asks for an overlap.
  Several pressed(two(2 * r), {springs, dashpot(0.9)}, -1e-3);
  ASSERT_EQ(pressed->state().bonds.size(), 0u);
  for (const Index k : {0, 1}) pressed->hold(k, dof::all, Vec3(k == 0 ? 1 : -1, 0, 0), Vec3::Zero());
  for (int k = 0; k < 20; ++k) {
    pressed->forces();
    pressed->advance();
  }
  for (const Index k : {0, 1}) pressed->hold(k, dof::all, Vec3(k == 0 ? -50 : 50, 0, 0), Vec3::Zero());
  pressed->forces();
  EXPECT_EQ(pressed->state().particles.force()[0].x(), 0) << "parting: the dashpot takes all of the push, and no more";
}

/// M = k theta until mu R |F|; what slides is accounted for.
TEST(AddingLaws, RollingIsResistedByASpringThatSlides) {
  const double mu = 0.2, twisting = 0.1, push_in = 1e-6, radius = r / 2, k = 10e9 * radius * radius * radius;
  Several s(two(), {springs, rolling(mu, twisting)}, -1e-3);
  for (const Index a : {0, 1}) s->hold(a, dof::all, Vec3::Zero(), Vec3::Zero());
  const double dt = s->time_step();
  s->hold(1, dof::all, Vec3(-push_in / dt, 0, 0), Vec3::Zero());
  s->forces();
  s->advance();
  s->hold(1, dof::all, Vec3::Zero(), Vec3::Zero());
  s->forces();
  s->mark_start_of_loading();
  const double push = -s->state().particles.force()[0].x();
  ASSERT_GT(push, 0);
  const double turn = 1e-7;  // of one against the other, in a step [rad]
  for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(1, 0, 0)}) {
    const double limit = (axis.x() > 0 ? twisting : mu) * radius * push;
    const int to_the_limit = int(limit / k / turn);
    ASSERT_GT(to_the_limit, 10);
    s->hold(0, dof::all, Vec3::Zero(), -0.5 * turn / dt * axis);
    s->hold(1, dof::all, Vec3::Zero(), 0.5 * turn / dt * axis);
    for (int n = 1; n <= 2 * to_the_limit; ++n) {
      s->advance();
      s->forces();
      const double moment = s->state().pairs.moment[0].dot(axis);
      EXPECT_NEAR(moment, std::min(k * n * turn, limit), 1e-6 * limit) << n;
    }
    for (const Index a : {0, 1}) s->hold(a, dof::all, Vec3::Zero(), Vec3::Zero());
  }
  const EnergyLedger e = s->view().energy;
  EXPECT_NEAR(e.error(), 0, 1e-6 * e.boundary_work);
  EXPECT_GT(e.friction, 0.2 * e.boundary_work);
  EXPECT_NEAR(s->state().dissipated[1].friction, e.friction, 1e-12 * e.friction) << "of the second law's account";
  EXPECT_EQ(s->state().dissipated[0].friction, 0);
}

/// A law that adds nothing changes no bit; nor does the number of threads.
TEST(AddingLaws, SumsAreTheSameForAnyThreads) {
  const auto run = [](const std::vector<std::pair<std::string, Json>>& list, int threads) {
    EngineSettings settings;
    settings.threads = threads;
    Several s(random_block(6, 6, 6, r, 3), list, 0.05, settings);
    std::mt19937_64 random(4);
    const auto uniform = [&] { return 2 * double(random() >> 11) * 0x1p-53 - 1; };
    for (Index k = 0; k < s->state().particles.size(); ++k) {
      s->hold(k, dof::all, 2 * Vec3(uniform(), uniform(), uniform()), Vec3::Zero());
      s->release(k, dof::all);
    }
    for (int k = 0; k < 300; ++k) {
      s->forces();
      s->advance();
    }
    const auto position = s->state().particles.position();
    return std::vector<Vec3>(position.begin(), position.end());
  };
  const auto same = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
  };
  const std::pair<std::string, Json> brittle = {"elastic_brittle", elastic_brittle()};
  const auto all = run({brittle, dashpot(0.1, 0.1), rolling(0.2, 0.1)}, 1);
  EXPECT_FALSE(same(all, run({brittle}, 1)));
  for (const int threads : {2, 3, 8})
    EXPECT_TRUE(same(all, run({brittle, dashpot(0.1, 0.1), rolling(0.2, 0.1)}, threads)));
}

/// Broken, rubbing, rolling and damped: the balance closes.
TEST(AddingLaws, EnergyCloses) {
  EngineSettings settings;
  settings.safety = 0.2;
  Several s(random_block(5, 5, 5, r, 9),
            {{"elastic_brittle", elastic_brittle({{"tensile_strength", 1e6}, {"shear_strength", 1e6}})},
             dashpot(0.1, 0.05),
             rolling(0.3, 0.1)},
            0.05, settings);
  for (Index k = 0; k < s->state().particles.size(); ++k) {
    const Vec3 x = s->state().particles.position()[k] - 5 * r * Vec3(1, 1, 1);
    s->hold(k, dof::all, -1e3 * x, Vec3(0, 0, 200));
    s->release(k, dof::all);
  }
  s->forces();
  s->mark_start_of_loading();
  for (int k = 0; k < 4000; ++k) {
    s->advance();
    s->forces();
  }
  const EnergyLedger e = s->view().energy;
  EXPECT_GT(s->broken_bonds(), 50u);
  EXPECT_GT(e.contact, 0);
  EXPECT_GT(e.friction, 0);
  EXPECT_LT(std::abs(e.error()), 0.01 * e.initial);
}

}  // namespace
}  // namespace breccia::testing
