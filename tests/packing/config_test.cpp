// SPDX-License-Identifier: BSD-3-Clause
/// What a user gets wrong must come back as a text that names it.
#include <gtest/gtest.h>

#include "support.hpp"

namespace breccia::labra_onate {
namespace {

std::string findings(const Json& config) {
  std::string text;
  for (const Issue& i : FactoryOf<LabraOnate>().check(config)) text += i.path + ": " + i.text + "\n";
  return text;
}

std::string refusal(const Json& config, int dimension = 3) {
  TestHost host;
  try {
    pack(config, host, 1, dimension);
  } catch (const UserError& e) { return e.what(); }
  return "accepted";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "got: " << text;
}

TEST(Config, GoodOnesHaveNoFindings) {
  EXPECT_EQ(findings(small_cylinder()), "");
  EXPECT_EQ(findings(small_box()), "");
  EXPECT_EQ(findings(small_rectangle()), "");
}

TEST(Config, EveryParameterIsDocumented) {
  const FactoryOf<LabraOnate> factory;
  const auto visit = [](const auto& self, const ParamSpec& p) -> void {
    for (const ParamSpec& m : p.members) {
      EXPECT_FALSE(m.doc.empty()) << m.name;
      self(self, m);
    }
  };
  visit(visit, factory.documentation().root);
}

TEST(Config, NeedsParticlesOrPorosity) {
  Json j = small_cylinder();
  j.erase("porosity");
  expect_contains(findings(j), "needs particles, or porosity");
}

TEST(Config, ContainerMustBeWhole) {
  Json j = small_cylinder();
  j["container"].erase("height");
  expect_contains(findings(j), "container: a cylinder is given by diameter and height");
  j = small_box();
  j["container"]["diameter"] = 0.01;
  expect_contains(findings(j), "container: a box is given by size");
  j = small_box();
  j["container"]["size"] = {0.01, -0.01, 0.01};
  expect_contains(findings(j), "above zero");
}

TEST(Config, RadiiMustBeConsistent) {
  Json j = small_cylinder();
  j["radius"]["mean"] = 2e-3;
  expect_contains(findings(j), "radius: the mean is not between min and max");
  j = small_cylinder();
  j["radius"]["standard_deviation"] = 0.5e-3;
  expect_contains(findings(j), "radius: no distribution");
  j = small_cylinder();
  j["radius"].erase("mean");
  expect_contains(findings(j), "radius: this distribution needs mean and standard_deviation");
  j["radius"] = {{"distribution", "uniform"}, {"min", 1e-3}};
  expect_contains(findings(j), "radius: a uniform distribution needs min and max");
  j["radius"] = {{"distribution", "uniform"}, {"min", 1e-3}, {"max", 2e-3}, {"mean", 1.6e-3}};
  expect_contains(findings(j), "radius: a uniform distribution follows from min and max alone");
  j["radius"] = {{"distribution", "uniform"}, {"mean", 1e-3}, {"standard_deviation", 0.9e-3}};
  expect_contains(findings(j), "radius: this standard_deviation gives radii below zero");
}

TEST(Config, TheLargestMustFit) {
  Json j = small_cylinder();
  j["radius"] = {{"distribution", "uniform"}, {"min", 4e-3}, {"max", 6e-3}};
  expect_contains(findings(j), "radius: the largest radius does not fit");
}

TEST(Config, DimensionAndContainerMustAgree) {
  expect_contains(refusal(small_cylinder(), 2), "a cylinder cannot be packed in two dimensions");
  expect_contains(refusal(small_rectangle(), 3), "three entries in size");
}

TEST(Config, PorosityOutOfReachIsRefused) {
  Json j = small_cylinder();
  j["porosity"] = 0.05;
  expect_contains(refusal(j), "a porosity of 5 % is out of reach");
}

TEST(Config, TightAndLoosePorositiesWarn) {
  Json j = small_cylinder();
  j["max_iterations"] = 5;
  TestHost host;
  j["porosity"] = 0.15;
  pack(j, host);
  expect_contains(host.warnings, "large overlaps");
  j["porosity"] = 0.6;
  pack(j, host);
  expect_contains(host.warnings, "too loose");
}

TEST(Config, ContradictingNumberAndPorosityAreRefusedOrScaled) {
  Json j = small_cylinder();
  j["particles"] = 100;
  expect_contains(refusal(j), "these radii do not go with this porosity");
  j["particles"] = 600;
  j["max_iterations"] = 5;
  TestHost host;
  const PackedParticles p = pack(j, host);
  expect_contains(host.warnings, "all radii were multiplied by");
  EXPECT_EQ(p.radius.size(), 600u);
  EXPECT_NEAR(got(p, "radius_mean"), got(p, "radius_factor") * 0.6e-3, 1e-12);
}

}  // namespace
}  // namespace breccia::labra_onate
