// SPDX-License-Identifier: BSD-3-Clause
// The pair list against a search of all pairs, the bonding rules and the time step.
#include <gtest/gtest.h>

#include <set>

#include "engine/time_step.hpp"
#include "support/support.hpp"

namespace breccia::testing {
namespace {

TEST(Neighbours, NoContactIsMissedBetweenRebuilds) {
  Bench b = make_bench(random_block(6, 6, 6, 1e-3, 2), elastic_brittle(), 0.05);
  b->prepare();
  for (Index k = 0; k < b->state().particles.size(); ++k) {
    const Vec3 x = b->state().particles.position()[k] - Vec3::Constant(6e-3);
    b->hold(k, dof::all, -3e3 * x, Vec3::Zero());  // collapse: new contacts all the time
    b->release(k, dof::all);
  }
  const std::uint64_t first = b->rebuilds();
  for (int k = 0; k < 40; ++k) {
    b.steps(5);
    b->forces();
    const State& s = b->state();
    std::set<std::pair<Index, Index>> listed;
    for (std::size_t q = 0; q < s.pairs.size(); ++q) listed.insert({s.pairs.i[q], s.pairs.j[q]});
    ASSERT_EQ(listed.size(), s.pairs.size());
    for (Index i = 0; i < s.particles.size(); ++i)
      for (Index j = i + 1; j < s.particles.size(); ++j)
        if ((s.particles.position()[i] - s.particles.position()[j]).norm() <
            s.particles.radius()[i] + s.particles.radius()[j]) {
          ASSERT_TRUE(listed.contains({i, j})) << i << " " << j << " after " << k;
        }
  }
  EXPECT_GT(b->rebuilds(), first) << "the test must rebuild";
}

TEST(Neighbours, BondsByLimitAndByCoordinationNumber) {
  const PackedParticles p = random_block(7, 7, 7, 1e-3, 4);
  auto law = make_law();
  for (const GapMeasure measure : {GapMeasure::relative, GapMeasure::absolute}) {
    Simulation by_number(assemble(p, {2650}, 3, 1), *law, {});
    const BondingResult found = by_number.bond({measure, std::nullopt, 9.0});
    EXPECT_NEAR(found.coordination_number, 9.0, 2.0 / 343);
    EXPECT_EQ(found.measure, measure);
    Simulation by_limit(assemble(p, {2650}, 3, 1), *law, {});
    by_limit.bond({measure, found.limit, std::nullopt});
    EXPECT_EQ(by_number.state().bonds.i, by_limit.state().bonds.i);
    EXPECT_EQ(by_number.state().bonds.j, by_limit.state().bonds.j);
    // Against all pairs.
    std::size_t count = 0;
    for (std::size_t i = 0; i < 343; ++i)
      for (std::size_t j = i + 1; j < 343; ++j) {
        const double touching = p.radius[i] + p.radius[j], d = (p.position[i] - p.position[j]).norm();
        count += measure == GapMeasure::relative ? d <= (1 + found.limit) * touching : d <= touching + found.limit;
      }
    EXPECT_EQ(count, by_number.state().bonds.size());
  }
}

TEST(Neighbours, TheGapItselfBondsSmallParticlesThatTheRelativeGapDoesNot) {
  // Gaps of 0.1 mm between two small spheres and of 0.15 mm between two large ones: 0.5 and 0.075 of the sums of radii.
  PackedParticles p;
  p.position = {Vec3(0, 0, 0), Vec3(0.3e-3, 0, 0), Vec3(10e-3, 0, 0), Vec3(12.15e-3, 0, 0)};
  p.radius = {0.1e-3, 0.1e-3, 1e-3, 1e-3};
  auto law = make_law();
  for (const GapMeasure measure : {GapMeasure::relative, GapMeasure::absolute}) {
    Simulation s(assemble(p, {2650}, 3, 1), *law, {});
    s.bond({measure, std::nullopt, 0.5});  // one bond
    ASSERT_EQ(s.state().bonds.size(), 1u);
    const double r = s.state().particles.radius()[s.state().bonds.i[0]];
    EXPECT_EQ(r, measure == GapMeasure::relative ? 1e-3 : 0.1e-3);
  }
}

TEST(Neighbours, ALatticeKeepsItsSymmetryWhenBondedByNumber) {
  auto law = make_law();
  Simulation s(assemble(simple_cubic(5, 5, 5, 1e-3), {2650}, 3, 1), *law, {});
  s.bond({GapMeasure::relative, std::nullopt, 4.0});  // fewer than the lattice has: equal gaps stand together
  EXPECT_EQ(s.state().bonds.size(), 300u);
}

TEST(Neighbours, ImpossibleCoordinationNumberIsTheUsersError) {
  auto law = make_law();
  Simulation s(assemble(simple_cubic(2, 1, 1, 1e-3), {2650}, 3, 1), *law, {});
  EXPECT_THROW(s.bond({GapMeasure::relative, std::nullopt, 11.0}), UserError);
}

TEST(TimeStep, TwoEqualSpheresOscillateAtTheFrequencyTheBoundGives) {
  // Two free spheres on one spring: omega^2 = 2 K/m, and the bound is exact for the normal mode when it is the
  // stiffest.
  Bench b = make_bench(simple_cubic(2, 1, 1, 1e-3), elastic_brittle({{"stiffness_ratio", 1e9}}), 1e-9);
  b->prepare();
  const double k = 2 * 10e9 * 1e-3, m = b->state().particles.mass()[0];
  EXPECT_NEAR(b->critical_step(), 2 / std::sqrt(2 * k / m), 1e-6 * b->critical_step());
}

TEST(TimeStep, AWallThatABodyReachesLaterCounts) {
  Bench b = make_bench(simple_cubic(2, 1, 1, 1e-3), elastic_brittle(), 1e-9);
  b->add_wall({"stiff", Vec3(0, 0, -1e-3), Vec3::UnitZ(), 1e10, 0, 0});
  b->prepare();
  const double far = b->time_step();
  for (Index k = 0; k < 2; ++k) {
    b->hold(k, dof::translation, Vec3(0, 0, -20), Vec3::Zero());
    b->release(k, dof::all);
  }
  b->mark_start_of_loading();
  const double start = b->view().energy.initial;
  b.steps(int(1.5e-3 / (20 * far)));
  b->forces();
  EXPECT_LT(b->time_step(), 2 / std::sqrt(1e10 / b->state().particles.mass()[0]));
  EXPECT_LT(b->view().energy.kinetic, 1.05 * start) << "bounced, not thrown";
}

TEST(TimeStep, StableAtTheBoundUnstableFarAboveIt) {
  for (const double safety : {1.0, 2.2}) {
    EngineSettings settings;
    settings.safety = safety;
    Bench b = make_bench(random_block(4, 4, 4, 1e-3, 9),
                         elastic_brittle({{"tensile_strength", 1e15}, {"shear_strength", 1e15}}), 0.15, settings);
    b->prepare();
    b->hold(0, dof::translation, Vec3(1e-3, 2e-3, 3e-3), Vec3::Zero());
    b->release(0, dof::all);
    b->mark_start_of_loading();
    const double start = b->view().energy.initial;
    double most = 0;
    try {
      for (int k = 0; k < 40; ++k) {
        b.steps(50);
        most = std::max(most, b->view().energy.kinetic);
      }
    } catch (const UserError&) {
      most = 1e300;  // ran away, and said so
    }
    if (safety <= 1) EXPECT_LT(most, 2 * start);
    else EXPECT_GT(most, 10 * start);
  }
}

}  // namespace
}  // namespace breccia::testing
