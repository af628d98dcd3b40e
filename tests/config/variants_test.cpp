// SPDX-License-Identifier: BSD-3-Clause
/// Variants: named changes that a workflow holds, laid over it like a file over its base.
#include <gtest/gtest.h>

#include "config/reader.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

constexpr const char* workflow = R"(title: specimen 1
specimen: {diameter: 23 mm, slenderness: 2, porosity: 23 %}
levels: [1 MPa, 2 MPa, 3 MPa]
contact_law: {type: brittle, bond_modulus: 10 GPa, tensile_strength: 40 MPa, friction: 0.3}
variants:
  small: {specimen: {diameter: 5 mm}, contact_law: {friction: 0.1}}
  wrong: {specimen: {diametre: 5 mm}}
)";

Json read(const std::string& text, const std::string& variant, const std::vector<std::string>& overrides = {}) {
  return read_config(follow_bases(text, "workflow.yaml"), fake::root(), fake::Plugins(), overrides, fake::rules,
                     variant);
}

std::string problem(const std::string& text, const std::string& variant) {
  try {
    return "no problem: " + read(text, variant).dump();
  } catch (const UserError& e) { return e.what(); }
}

TEST(Variants, AreLaidOverTheWorkflow) {
  const Json whole = read(workflow, ""), small = read(workflow, "small");
  EXPECT_NEAR(whole["specimen"]["diameter"].get<double>(), 23e-3, 1e-15);
  EXPECT_NEAR(small["specimen"]["diameter"].get<double>(), 5e-3, 1e-15);
  EXPECT_EQ(small["specimen"]["slenderness"], 2);
  EXPECT_EQ(small["contact_law"]["friction"], 0.1);
  EXPECT_EQ(small["contact_law"]["bond_modulus"], 10e9);
  EXPECT_FALSE(small.contains("variants"));
}

TEST(Variants, ValuesOfTheCommandLineAreOnTop) {
  EXPECT_EQ(read(workflow, "small", {"contact_law.friction=0.7"})["contact_law"]["friction"], 0.7);
}

TEST(Variants, MistakesInOneAreReportedWhereTheyStand) {
  EXPECT_EQ(problem(workflow, ""), "no problem: " + read(workflow, "").dump())
      << "a variant that is not asked for does not count";
  EXPECT_EQ(problem(workflow, "wrong").substr(0, 43), "workflow.yaml:7:22: specimen.diametre: is n");
}

TEST(Variants, UnknownOnesAreRefusedWithASuggestion) {
  EXPECT_EQ(problem(workflow, "smal"), "workflow.yaml: there is no variant `smal`; did you mean `small`?");
  const std::string without = std::string(workflow).substr(0, std::string(workflow).find("variants:"));
  EXPECT_EQ(problem(without, "small"), "workflow.yaml: there is no variant `small`: the workflow has no `variants`");
}

TEST(Variants, MustBeMappingsWithoutBasesOrVariantsOfTheirOwn) {
  const std::string without = std::string(workflow).substr(0, std::string(workflow).find("variants:"));
  EXPECT_EQ(problem(without + "variants: 3\n", ""),
            "workflow.yaml:5:1: variants: must be a mapping: the name of each variant, and what differs in it");
  EXPECT_EQ(problem(without + "variants: {a: 3}\n", ""),
            "workflow.yaml:5:12: variants.a: must be a mapping of what differs in this variant");
  EXPECT_EQ(problem(without + "variants: {a: {base: x.yaml}}\n", ""),
            "workflow.yaml:5:16: variants.a.base: a variant has no base of its own");
}

TEST(Variants, AreListedInOrder) {
  EXPECT_EQ(variants_of(follow_bases(workflow, "workflow.yaml")), (std::vector<std::string>{"small", "wrong"}));
}

}  // namespace
}  // namespace breccia
