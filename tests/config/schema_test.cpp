// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "config/describe.hpp"
#include "config/json_schema.hpp"
#include "config/reader.hpp"
#include "config/writer.hpp"
#include "config/yaml_tree.hpp"
#include "fake_workflow.hpp"
#include "schema_conformance.hpp"

namespace breccia {
namespace {

std::string schema_problem(const std::string& text) {
  std::vector<Finding> findings;
  const YamlPtr tree = parse_yaml(text, {}, findings);
  if (!tree || !findings.empty()) return "not YAML";
  return SchemaChecker::problem(json_schema(fake::root(), fake::Plugins()), plain_json(*tree));
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

TEST(JsonSchema, AdmitsWhatTheReaderAdmits) {
  EXPECT_EQ(schema_problem(fake::valid), "");
  const fake::Plugins plugins;
  const Json config = read_config(fake::valid, "/folder/workflow.yaml", fake::root(), plugins);
  EXPECT_EQ(schema_problem(write_yaml(config, fake::root(), plugins)), "");
}

class Refused : public testing::TestWithParam<std::pair<const char*, const char*>> {};
TEST_P(Refused, BySchemaAndReader) {
  const std::string text = replaced(fake::valid, GetParam().first, GetParam().second);
  EXPECT_NE(schema_problem(text), "");
  EXPECT_THROW(read_config(text, "/folder/workflow.yaml", fake::root(), fake::Plugins()), ConfigError);
}
INSTANTIATE_TEST_SUITE_P(
    JsonSchema, Refused,
    testing::Values(std::pair{"seed: 42", "sed: 42"}, std::pair{"seed: 42", "seed: 4.5"},
                    std::pair{"seed: 42", "seed: -4"}, std::pair{"gravity: true", "gravity: yes"},
                    std::pair{"diameter: 23 mm", "diameter: 23"}, std::pair{"diameter: 23 mm", "diameter: wide"},
                    std::pair{"slenderness: 2.25", "height: 1 m\n  slenderness: 2"},
                    std::pair{"slenderness: 2.25\n", "\n"}, std::pair{"slow: 3", "slow: 3\nquick: 2"},
                    std::pair{"safety: 30 %", "safety: 1.5"}, std::pair{"type: brittle", "type: britle"},
                    std::pair{"type: brittle", "type: soft"}, std::pair{"type: brittle", "kind: brittle"},
                    std::pair{"model: model_2", "model: model_3"}, std::pair{"[1 MPa, 70 psi, 0.1 GPa]", "[]"},
                    std::pair{"[1 MPa, 70 psi, 0.1 GPa]", "1 MPa"}, std::pair{"[1 m, 1 m, 1 m]", "[1 m, 1 m]"},
                    std::pair{"every: 2 ms", "often: 2 ms"}, std::pair{"  type: brittle\n", "\n"},
                    std::pair{"- type: stress\n    every", "- every"}, std::pair{"  diameter: 23 mm\n", ""},
                    std::pair{"point: [0 m, 1 mm, -2 cm], ", ""}, std::pair{"bond_modulus: &stiff 10 GPa", "#"}));

TEST(JsonSchema, AdmitsAnythingForAPluginThatDoesNotLoad) {
  EXPECT_EQ(schema_problem("specimen: {diameter: 1 m, height: 1 m}\ncontact_law: {type: absent, what: ever}\n"), "");
}

// Partial files: what the base has is not asked for, what is written is still checked.
TEST(JsonSchema, AsksForNothingThatTheBaseMayHave) {
  for (const char* rest : {"", "seed: 2\n", "specimen: {porosity: 20 %}\n", "contact_law: {model: model_2}\n",
                           "contact_law: {type: brittle, model: model_2}\n", "specimen: {height: 1 m}\n"}) {
    EXPECT_EQ(schema_problem(std::string("base: specimen.yaml\n") + rest), "") << rest;
    EXPECT_NE(schema_problem(rest[0] ? rest : "{}"), "") << rest;
  }
  for (const char* wrong : {"sed: 2\n", "seed: -2\n", "specimen: {porosity: wide}\n", "specimen: {hight: 1 m}\n",
                            "specimen: {height: 1 m, slenderness: 2}\n", "contact_law: {type: brittle, modl: 2}\n",
                            "contact_law: {type: britle}\n", "postprocessor: [{every: 2 ms}]\n",
                            "postprocessor: [{type: stress, walls: [{friction: 1}]}]\n", "base: [a.yaml]\n"})
    EXPECT_NE(schema_problem(std::string(wrong[0] == 'b' ? "" : "base: specimen.yaml\n") + wrong), "") << wrong;
}

TEST(JsonSchema, SaysWhatEditorsShow) {
  const Json schema = json_schema(fake::root(), fake::Plugins());
  const Json& diameter = schema["properties"]["specimen"]["properties"]["diameter"];
  EXPECT_EQ(diameter["description"], "of the cylinder; a length; above 0 m");
  EXPECT_EQ(schema["definitions"]["length"]["patternErrorMessage"], "a length such as m, cm or mm is needed");
  EXPECT_EQ(diameter["examples"][0], "23 mm");
  EXPECT_EQ(schema["properties"]["levels"]["default"], Json::parse(R"(["1e6 Pa", "2e6 Pa"])"));
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
}

Documentation law() { return fake::Plugins().documentation("contact_law", "brittle"); }

TEST(Describe, TextTellsUnitRangeDefaultChoicesAndSource) {
  const std::string text = describe_text("contact_law", "brittle", law());
  for (const char* part :
       {"contact_law brittle: brittle bonds", "source: a paper, Eq. 1", "licence: BSD-3-Clause",
        "tensile_strength  (quantity [Pa]; above 0 Pa, at most 1e9 Pa; required)",
        "    for instance tensile_strength: 40 MPa", "    source: Eq. 25", "model  (choice; default model_1)",
        "model_2: harmonic means", "friction  (number; at least 0; default 0.5)",
        "damping  (quantity [kg/s]; above 0 kg/s; optional)",
        "rule: cohesion is no longer a parameter; write `tensile_strength`"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(Describe, MarkdownIsOneTable) {
  const std::string text = describe_markdown("contact_law", "brittle", law());
  for (const char* part :
       {"### contact_law `brittle`\n",
        "| `bond_modulus` | quantity [Pa] | above 0 Pa | required | modulus of the bond; for instance `10 GPa` |\n",
        "F = K u | no more", "| `friction` | number | at least 0 | `0.5` |", "- cohesion is no longer a parameter"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  const std::string nested =
      describe_markdown("postprocessor", "stress", fake::Plugins().documentation("postprocessor", "stress"));
  EXPECT_NE(nested.find("| `walls[].point` | list of quantities [m], 3 items |"), std::string::npos) << nested;
}

TEST(Describe, MarkdownKeepsWhatLooksLikeATag) {
  Documentation doc = law();
  doc.details = "R = <r> over all | `<m>`";
  doc.root.members[0].doc = "mean <r>";
  const std::string text = describe_markdown("contact_law", "brittle", doc);
  EXPECT_NE(text.find("R = &lt;r> over all | `<m>`"), std::string::npos) << text;
  EXPECT_NE(text.find("mean &lt;r>"), std::string::npos) << text;
}

TEST(Describe, JsonHasTheNumbers) {
  const Json j = describe_json("contact_law", "brittle", law());
  EXPECT_EQ(j["name"], "brittle");
  EXPECT_EQ(j["parameters"].size(), 6u);
  const Json& strength = j["parameters"][2];
  EXPECT_EQ(strength["name"], "tensile_strength");
  EXPECT_EQ(strength["unit"], "Pa");
  EXPECT_EQ(strength["upper"], Json::parse(R"({"value": 1e9, "inclusive": true})"));
  EXPECT_EQ(j["parameters"][0]["choices"][1]["doc"], "harmonic means");
  EXPECT_EQ(j["removed"]["cohesion"], "write `tensile_strength`");
}

}  // namespace
}  // namespace breccia
