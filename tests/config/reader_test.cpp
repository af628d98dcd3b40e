// SPDX-License-Identifier: BSD-3-Clause
#include "config/reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "config/suggest.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

Json read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_config(text, "/folder/study/workflow.yaml", fake::root(), fake::Plugins(), overrides, fake::rules);
}

std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    return "no problem: " + read(text, overrides).dump();
  } catch (const ConfigError& error) { return error.what(); }
}

constexpr const char* minimal =
    "specimen: {diameter: 1 m, height: 2 m}\n"
    "contact_law: {type: soft, stiffness: 1 N/m}\n";

TEST(Reader, ReadsEveryTypeInSi) {
  const Json expected = Json::parse(R"({
    "title": "compression: \"dry\" rock", "seed": 42, "steps": 1000000, "safety": 0.3, "gravity": true,
    "specimen": {"diameter": 0.023, "slenderness": 2.25, "porosity": 0.23},
    "particles": "/folder/data/spheres.csv", "levels": [1e6, 0, 1e8],
    "contact_law": {"type": "brittle", "model": "model_2", "bond_modulus": 1e10, "tensile_strength": 4e7,
                    "friction": 0.5, "angle": 0},
    "postprocessor": [
      {"type": "stress", "every": 0.002, "symmetric": true,
       "walls": [{"point": [0.0, 0.001, -0.02], "friction": 0.3}, {"point": [1.0, 1.0, 1.0], "friction": 0.0}]},
      {"type": "stress", "name": "second", "every": 0.001, "symmetric": false, "walls": []}],
    "expected": {"modulus": "10 GPa", "peaks": [1, 2.5, "3", true, null], "note": "as in \"table 2\""},
    "slow": 3.0})");
  Json got = read(fake::valid);
  EXPECT_NEAR(got["levels"][1].get<double>(), 482633.0, 1.0);  // 70 psi
  EXPECT_NEAR(got["contact_law"]["angle"].get<double>(), 0.5235987755982988, 1e-15);
  got["levels"][1] = 0;
  got["contact_law"]["angle"] = 0;
  EXPECT_EQ(got, expected);
}

TEST(Reader, FillsDefaultsOfPluginsThatNobodyNamed) {
  const Json got = read(minimal);
  EXPECT_EQ(got["postprocessor"],
            Json::parse(R"([{"type": "stress", "every": 0.001, "symmetric": true, "walls": []}])"));
  EXPECT_EQ(got["title"], "untitled");
  EXPECT_EQ(got["particles"], "/folder/study/particles.csv");
  EXPECT_FALSE(got.contains("quick"));
}

TEST(Reader, MembersComeInTheOrderOfTheirDeclaration) {
  const Json got =
      read("contact_law: {stiffness: 1 N/m, type: soft}\nseed: 3\nspecimen: {height: 2 m, diameter: 1 m}\n");
  std::vector<std::string> keys;
  for (const auto& [key, value] : got.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"title", "seed", "steps", "safety", "gravity", "specimen", "particles",
                                            "levels", "contact_law", "postprocessor", "expected"}));
  EXPECT_EQ(got["specimen"].begin().key(), "diameter");
  EXPECT_EQ(got["contact_law"].begin().key(), "type");
}

/// It would be -1 wherever a signed number holds it.
TEST(Reader, WholeNumbersEndWhereASignedOneDoes) {
  for (const char* n : {"9223372036854775808", "18446744073709551615"})
    EXPECT_NE(problems_of(std::string(minimal) + "seed: " + n + "\n").find("the largest is 9223372036854775807"),
              std::string::npos)
        << n;
}

TEST(Reader, NumbersHaveTheTypeOfTheSchema) {
  const Json got = read(std::string(minimal) + "seed: 9223372036854775807\nsteps: 2.0e3\nquick: 3\n");
  EXPECT_EQ(got["seed"].get<std::uint64_t>(), 9223372036854775807u);
  EXPECT_TRUE(got["steps"].is_number_integer());
  EXPECT_TRUE(got["quick"].is_number_float());
}

TEST(Reader, ByteOrderMarkWindowsLineEndsAndUnicodeAreFine) {
  std::string text = std::string("\xEF\xBB\xBF") + minimal + "title: gr\xC3\xA8s\n";
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(windows)["title"], "gr\xC3\xA8s");
}

TEST(Reader, ColumnsCountCharacters) {
  EXPECT_EQ(problems_of(std::string(minimal) + "expected: {gr\xC3\xA8s: 1, \xC3\xA8: 2, \xC3\xA8: 3}\n").substr(0, 50),
            "/folder/study/workflow.yaml:3:27: expected.\xC3\xA8: giv");
}

TEST(Reader, BlockScalarsHoldLongTexts) {
  EXPECT_EQ(read(std::string(minimal) + "title: |\n  two\n  lines\n")["title"], "two\nlines\n");
}

TEST(Reader, FindsAllProblemsInOnePass) {
  try {
    read(
        "seed: -1\nspecimen: {diameter: 1 Pa, height: 2}\ncontact_law: {type: brittle, bond_modulus: -1 GPa}\nsteps: "
        "ten\n");
    FAIL();
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.problems().size(), 6u) << error.what();
    int last = 0;
    for (const Problem& problem : error.problems()) {
      EXPECT_LE(last, problem.line);
      last = problem.line;
    }
  }
}

TEST(Overrides, ReplaceAndAddValues) {
  const Json got = read(fake::valid, {"contact_law.friction=0.25", "postprocessor.1.every=5 ms",
                                      "postprocessor[0].walls[1].friction=0.75", "levels=[3 MPa]",
                                      "specimen.diameter=50 mm", "expected.new.deep=7"});
  EXPECT_EQ(got["contact_law"]["friction"], 0.25);
  EXPECT_EQ(got["postprocessor"][1]["every"], 0.005);
  EXPECT_EQ(got["postprocessor"][0]["walls"][1]["friction"], 0.75);
  EXPECT_EQ(got["levels"], Json::array({3e6}));
  EXPECT_EQ(got["specimen"]["diameter"], 0.05);
  EXPECT_EQ(got["expected"]["new"]["deep"], 7);
}

TEST(Overrides, LeaveOtherUsesOfAnAnchorAlone) {
  const Json got = read(fake::valid, {"contact_law.bond_modulus=7 GPa"});
  EXPECT_EQ(got["contact_law"]["bond_modulus"], 7e9);
  EXPECT_EQ(got["expected"]["modulus"], "10 GPa");
}

TEST(Overrides, CanSwitchThePlugin) {
  const Json got = read(minimal, {"contact_law={type: brittle, bond_modulus: 1 GPa, tensile_strength: 1 MPa}"});
  EXPECT_EQ(got["contact_law"]["type"], "brittle");
}

TEST(Overrides, ReachSectionsThatTheFileDoesNotHave) {
  EXPECT_EQ(read("contact_law: {type: soft, stiffness: 1 N/m}\n",
                 {"specimen.diameter=1 m", "specimen.height=2 m"})["specimen"]["height"],
            2.0);
}

// Characters at fixed cost: a small text that would expand to gigabytes.
TEST(Guards, AliasBombsDoNotGoOff) {
  std::string text = "expected:\n  a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int k = 1; k < 12; ++k) {
    const std::string last = "*a" + std::to_string(k - 1), name = "a" + std::to_string(k);
    text += "  " + name + ": &" + name + " [" + last;
    for (int i = 1; i < 10; ++i) text += ", " + last;
    text += "]\n";
  }
  EXPECT_NE(problems_of(text + minimal).find("grows beyond all bounds"), std::string::npos);
}

TEST(Guards, DeepNestingDoesNotOverflow) {
  const std::string open(2000, '['), closed(2000, ']');
  EXPECT_NE(problems_of("expected: " + open + closed).find("nested too deeply"), std::string::npos);
  EXPECT_THROW(read("expected: " + std::string(100000, '[')), ConfigError);
  EXPECT_THROW(read("expected: " + std::string(100000, '{')), ConfigError);
  std::string dashes;
  for (int k = 0; k < 100000; ++k) dashes += "- ";
  EXPECT_NE(problems_of(dashes).find("nested too deeply"), std::string::npos);
}

TEST(Guards, FilesOfMoreThanFourMebibytesAreRefused) {
  EXPECT_NE(problems_of(std::string((4 << 20) + 1, ' ')).find("4 MiB"), std::string::npos);
}

TEST(Guards, BytesThatAreNotText) {
  EXPECT_NE(problems_of(std::string("title: a\0b\n", 11)).find(":1:9: a zero byte"), std::string::npos);
  EXPECT_NE(problems_of("title: a\xFF\n").find(":1:9: the text is not UTF-8"), std::string::npos);
  EXPECT_NE(problems_of("title: \xC0\xAF\n").find(":1:8: the text is not UTF-8"), std::string::npos);
  EXPECT_NE(problems_of("title: \xED\xA0\x80\n").find("not UTF-8"), std::string::npos);
  EXPECT_NE(problems_of("\xFF\xFEt\0").find("UTF-16"), std::string::npos);
  EXPECT_NE(problems_of("title: a\x07\n").find("control character"), std::string::npos);
  EXPECT_NE(problems_of("title: \"a\\0b\"\n").find("zero byte"), std::string::npos);
}

TEST(Suggestions, KnowSwapsAndCase) {
  EXPECT_EQ(edit_distance("frcition", "friction"), 1u);
  EXPECT_EQ(edit_distance("Friction", "friction"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(closest("elastic_britle", {"damage", "elastic_brittle", "net"}), "elastic_brittle");
  EXPECT_EQ(closest("mass", {"time", "stress"}), "");
  EXPECT_EQ(closest("friction_angle", {"friction", "internal_friction_angle", "cohesion"}), "internal_friction_angle");
  EXPECT_EQ(closest("angle_friction", {"internal_friction_angle"}), "internal_friction_angle");
  EXPECT_EQ(closest("angl", {"internal_friction_angle"}), "") << "a part of a word is none";
  EXPECT_EQ(closest("compression", {"uniaxial_compression", "biaxial_compression"}), "") << "there are two";
}

/// What is there by default can be reached into, as if it had been written.
TEST(Overrides, ReachIntoADefaultList) {
  const std::string text = "specimen: {diameter: 1 mm, height: 2 mm}\ncontact_law: {type: soft, stiffness: 15 MN/m}\n";
  Json config = read(text, {"postprocessor.0.every=2 ms"});
  EXPECT_EQ(config["postprocessor"], read(text + "postprocessor: [{type: stress, every: 2 ms}]\n")["postprocessor"]);
  config = read(text, {"levels.1=5 MPa"});
  EXPECT_EQ(config["levels"], Json({1e6, 5e6}));
  EXPECT_NE(problems_of(text, {"levels.2=5 MPa"}).find("has no item 2; it has 2"), std::string::npos);
}

}  // namespace
}  // namespace breccia
