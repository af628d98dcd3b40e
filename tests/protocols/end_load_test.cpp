// SPDX-License-Identifier: BSD-3-Clause
// `end_load`: which particles a group has, what is refused, and how the test ends.
#include "protocols/chain.hpp"

namespace breccia::testing {
namespace {

constexpr double r = 1e-3;

Json strong() { return elastic_brittle({{"tensile_strength", 1e12}, {"shear_strength", 1e12}}); }
Json load(Json changes) {
  Json one = {{"share", "equal"}};
  for (const auto& [key, value] : changes.items()) one[key] = value;
  return one;
}
const Json push = load({{"at", "upper"}, {"force", {1.0, 0, 0}}});

std::string said(const Json& config, int dimension = 3) {
  PackedParticles p = simple_cubic(3, dimension == 2 ? 9 : 3, dimension == 2 ? 1 : 9, r);
  if (dimension == 2)
    for (Vec3& x : p.position) x.z() = 0;
  try {
    ProtocolRun run(p, strong(), "elastic_brittle", 1e-6, "end_load", config, dimension);
  } catch (const UserError& e) { return e.what(); }
  return "nothing";
}
std::string issues(const Json& config) {
  std::string all;
  Json whole = config;
  for (const ParamSpec& p : registry().documentation("protocol", "end_load").root.members)
    if (!whole.contains(p.name) && !p.fallback.is_null()) whole[p.name] = p.fallback;
  for (const Issue& i : registry().check("protocol", "end_load", whole)) all += i.path + ": " + i.text + "\n";
  return all;
}

TEST(EndLoad, SaysWhatIsWrongBeforeItRuns) {
  const struct {
    Json config;
    const char* said;
  } mistakes[] = {
      {{{"supports", {{{"at", "lower"}, {"holds", {"rotations"}}}}}, {"loads", {push}}},
       "supports[0].holds: `rotations` is nothing that can be held"},
      {{{"supports", {{{"holds", {"all"}}}}}, {"loads", {push}}}, "supports[0]: says of no particles where they are"},
      {{{"loads", {load({{"at", "upper"}})}}}, "loads[0]: loads nothing"},
      {{{"loads", {push, push}}}, "loads[1]: `upper_load` is the name of another group"},
      {{{"loads", {push}}, {"release_after", 0.0}}, "release_after: needs `duration`"},
      {{{"loads", {load({{"x", {2e-3, 1e-3}}, {"force", {1.0, 0, 0}}})}}}, "loads[0].x: the first of the two"},
  };
  for (const auto& m : mistakes) EXPECT_NE(issues(m.config).find(m.said), std::string::npos) << issues(m.config);
  EXPECT_EQ(issues({{"supports", {{{"at", "lower"}, {"holds", {"all"}}}}}, {"loads", {push}}}), "");
}

TEST(EndLoad, SaysWhatDoesNotFitTheSpecimen) {
  const struct {
    Json config;
    int dimension;
    const char* said;
  } mistakes[] = {
      {{{"loads", {load({{"height", 2e-3}, {"depth", 1e-4}, {"force", {1.0, 0, 0}}})}}},
       3,
       "loads[0]: no centre of a particle lies there; the nearest is 0.00095 m outside"},
      {{{"loads", {load({{"at", "upper"}, {"x", {1e-1, 2e-1}}, {"force", {1.0, 0, 0}}})}}},
       3,
       "make the ranges of `x`, `y` and `z` wider"},
      {{{"supports", {{{"at", "upper"}, {"holds", {"x"}}}}}, {"loads", {push}}},
       3,
       "loads[0]: its force along x goes into a support"},
      {{{"supports", {{{"at", "lower"}, {"holds", {"x"}}}, {{"height", r}, {"holds", {"translation"}}}}},
        {"loads", {push}}},
       3,
       "supports[1] holds what another support holds already"},
      {{{"loads", {load({{"at", "upper"}, {"force", {0, 0, 1.0}}})}}}, 2, "in two dimensions a force has no z"},
      {{{"loads", {load({{"at", "upper"}, {"moment", {1.0, 0, 0}}})}}}, 2, "in two dimensions a force has no z"},
  };
  for (const auto& m : mistakes)
    EXPECT_NE(said(m.config, m.dimension).find(m.said), std::string::npos) << said(m.config, m.dimension);
}

/// What is shared adds up to what was asked for, and the reactions are its opposite.
TEST(EndLoad, ReactionsBalanceTheLoads) {
  for (const char* share : {"equal", "mass"}) {
    const Vec3 force(3, -1, 2), moment(0, 1e-3, 2e-3);
    ProtocolRun run(
        simple_cubic(4, 4, 8, r), strong(), "elastic_brittle", 0.2, "end_load",
        {{"supports", {{{"at", "lower"}, {"holds", {"all"}}}}},
         {"loads",
          {load({{"at", "upper"}, {"force", as_json(force)}, {"share", share}}),
           load({{"at", "middle"}, {"moment", as_json(moment)}, {"force", as_json(force)}, {"share", share}})}},
         {"rest", 1e-5}});
    run.go(200000, 2000);
    EXPECT_EQ(run.summary.at("stopped_by"), "rest");
    // Resultants of free particles may still add up to the share `rest` of the load.
    EXPECT_LT((vector_result(run, "lower_support_reaction_force", "N") + 2 * force).norm(), 1e-4 * force.norm());
    EXPECT_EQ(run.summary.at("particles").at("lower_support").get<int>(), 16) << "one layer";
  }
}

TEST(EndLoad, WhatNothingHoldsFliesOff) {
  ProtocolRun run(Chain::equal(3, 4, r).packing(), strong(), "elastic_brittle", 1e-6, "end_load",
                  {{"loads", {load({{"z", {-1.0, 1.0}}, {"force", {1.0, 0, 0}}, {"share", "mass"}})}},
                   {"ramp_time", 0.0},
                   {"max_displacement", 1e-4}},
                  3, 1, 0.0);
  double time = 0;
  run.go(
      1000000, [&](Simulation& sim) { time = sim.time(); }, 1);
  EXPECT_EQ(run.summary.at("stopped_by"), "max_displacement");
  // x = F t^2/(2 M), a rigid body.
  const double M = 5 * 2650 * 4.0 / 3.0 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(vector_result(run, "load_1_displacement", "m").x(), 0.5 * time * time / M, 0.02e-4);
}

}  // namespace
}  // namespace breccia::testing
