// SPDX-License-Identifier: BSD-3-Clause
#include "config/at_path.hpp"

#include <gtest/gtest.h>

#include "config/each_value.hpp"
#include "config/reader.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

class AtPath : public ::testing::Test {
 protected:
  const fake::Plugins plugins_;
  const Json config_ = read_config(fake::valid, "/folder/study/workflow.yaml", fake::root(), plugins_);
  std::string unit(const std::string& path) const {
    const auto spec = spec_at(config_, fake::root(), plugins_, path);
    return spec ? spec->unit : "no parameter";
  }
};

TEST_F(AtPath, BothWaysOfWritingAListItemLeadToTheSameValue) {
  for (const char* path : {"postprocessor.0.walls.1.point.2", "postprocessor[0].walls[1].point[2]"}) {
    const Json* value = value_at(config_, path);
    ASSERT_NE(value, nullptr) << path;
    EXPECT_EQ(*value, 1.0);
  }
  EXPECT_EQ(*value_at(config_, "contact_law.type"), "brittle");
  EXPECT_EQ(*value_at(config_, "specimen"), config_["specimen"]);
}

TEST_F(AtPath, WhatIsNotThereIsNothing) {
  for (const char* path :
       {"", "nothing", "specimen.nothing", "specimen.diameter.more", "postprocessor.2", "postprocessor.-1",
        "postprocessor.first", "postprocessor.0x", "postprocessor.", "postprocessor.99999999999999999999", "title.0"})
    EXPECT_EQ(value_at(config_, path), nullptr) << path;
}

TEST_F(AtPath, TheParameterIsThatOfTheSchemaOrOfThePluginThatWasPicked) {
  EXPECT_EQ(unit("specimen.diameter"), "m");
  EXPECT_EQ(unit("contact_law.bond_modulus"), "Pa");
  EXPECT_EQ(unit("contact_law.stiffness"), "no parameter");  // of another law
  EXPECT_EQ(unit("postprocessor.1.every"), "s");
  EXPECT_EQ(unit("postprocessor.1.name"), "1");  // that every plugin of a list has
  EXPECT_EQ(unit("postprocessor[0].walls[1].point"), "m");
  EXPECT_EQ(unit("postprocessor[0].walls[1].point[2]"), "m");
  EXPECT_EQ(unit("levels.0"), "Pa");
  const auto group = spec_at(config_, fake::root(), plugins_, "specimen");
  ASSERT_TRUE(group);
  EXPECT_EQ(group->type, ParamType::group);
  const auto item = spec_at(config_, fake::root(), plugins_, "postprocessor.0");
  ASSERT_TRUE(item);
  EXPECT_EQ(item->type, ParamType::plugin);
}

TEST_F(AtPath, NoParameterStandsWhereNoneIsDeclared) {
  for (const char* path : {"expected.modulus", "contact_law.type", "postprocessor.2.every", "levels.4", "levels.0.0",
                           "specimen.height", "quick", "nothing", ""})
    EXPECT_EQ(unit(path), "no parameter") << path;
}

/// Both ways through the tree know the same parameters.
TEST_F(AtPath, EveryValueHasTheParameterThatTheWalkThroughAllOfThemMeets) {
  Json copy = config_;
  std::size_t seen = 0;
  each_value(copy, fake::root(), plugins_, [&](const ParamSpec& met, const std::string& path, Json& value) {
    ++seen;
    const Json* at = value_at(config_, path);
    ASSERT_NE(at, nullptr) << path;
    EXPECT_EQ(*at, value) << path;
    const auto spec = spec_at(config_, fake::root(), plugins_, path);
    ASSERT_TRUE(spec) << path;
    EXPECT_EQ(spec->name, met.name) << path;
    EXPECT_EQ(spec->unit, met.unit) << path;
    EXPECT_EQ(spec->type, met.type) << path;
  });
  EXPECT_GT(seen, 20U);
}

struct Grains {
  double strength;
  ByName<double> shares;
  static void describe(Schema<Grains>& s) {
    s.param("strength", &Grains::strength).unit("Pa").above(0).doc("of a bond");
    s.param("shares", &Grains::shares).unit("m3").doc("by name");
    s.mark_per_bond("strength");
  }
};

TEST_F(AtPath, ADistributionHasTheUnitOfWhatScatters) {
  Schema<Grains> schema;
  Grains::describe(schema);
  const ParamSpec& root = schema.documentation().root;
  const Json config = {
      {"strength", {{"distribution", "weibull"}, {"mean", 1e7}, {"modulus", 4.0}}},
      {"shares", {{"quartz", 0.3}}},
  };
  const auto at = [&](const char* path) {
    const auto spec = spec_at(config, root, plugins_, path);
    return spec ? spec->name + " in " + spec->unit : "no parameter";
  };
  EXPECT_EQ(at("strength"), "strength in Pa");
  EXPECT_EQ(at("strength.mean"), "mean in Pa");
  EXPECT_EQ(at("strength.modulus"), "modulus in 1");
  EXPECT_EQ(at("shares.quartz"), "shares in m3");
  EXPECT_EQ(at("shares.mica"), "no parameter");
}

}  // namespace
}  // namespace breccia
