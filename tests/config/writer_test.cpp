// SPDX-License-Identifier: BSD-3-Clause
#include "config/writer.hpp"

#include <gtest/gtest.h>

#include "config/reader.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

Json read(const std::string& text) { return read_config(text, "/folder/workflow.yaml", fake::root(), fake::Plugins()); }

TEST(Writer, WhatItWritesReadsBackTheSame) {
  const fake::Plugins plugins;
  const Json config = read(fake::valid);
  const std::string text = write_yaml(config, fake::root(), plugins);
  // From another folder: paths are absolute by now. dump() prints the shortest numbers that differ when bits do.
  EXPECT_EQ(read_config(text, "/elsewhere/resolved.yaml", fake::root(), plugins).dump(), config.dump()) << text;
  EXPECT_NE(text.find("  diameter: 0.023 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  bond_modulus: 1e10 Pa\n"), std::string::npos) << text;
}

TEST(Writer, AwkwardNumbersKeepTheirBits) {
  std::string text =
      "specimen: {diameter: 0.1000000000000000055511151231257827 in, height: 1e-310 m}\n"
      "contact_law: {type: soft, stiffness: 4.9406564584124654e-324 N/m}\nsafety: 0.30000000000000004\n"
      "expected: {a: -0.0, b: 1e22, c: 0.1, d: 123456789012345678901, e: -7, f: 9007199254740993}\n";
  const Json config = read(text);
  EXPECT_EQ(read(write_yaml(config, fake::root(), fake::Plugins())).dump(), config.dump());
}

TEST(Writer, AwkwardTextsStayTexts) {
  Json config = read("specimen: {diameter: 1 m, height: 1 m}\ncontact_law: {type: soft, stiffness: 1 N/m}\n");
  for (const char* text :
       {"true",        "~",          "null", "12",  "010",  "a: b", "a #b", "# c", "- d",          "",
        " ",           "it's \"q\"", "*x",   "&y",  "!z",   "%d",   "@e",   "`f",  "two\nlines\n", "tab\there",
        "gr\xC3\xA8s", "[g]",        "{h",   "yes", "\x7F", "key:", "...",  "---", "\\n"}) {
    config["title"] = text;
    config["expected"] = {{"as value", text}, {text, "as key"}, {"in list", {text, text}}};
    const std::string yaml = write_yaml(config, fake::root(), fake::Plugins());
    EXPECT_EQ(read(yaml).dump(), config.dump()) << yaml;
  }
}

TEST(Writer, NestedListsAndEmptyOnes) {
  Json config =
      read("specimen: {diameter: 1 m, height: 1 m}\ncontact_law: {type: soft, stiffness: 1 N/m}\npostprocessor: []\n");
  config["expected"] = Json::parse(R"({"a": [[1, 2], [[3], {"b": []}], {}], "c": {}, "d": [{"e": null}, null]})");
  const std::string yaml = write_yaml(config, fake::root(), fake::Plugins());
  EXPECT_EQ(read(yaml).dump(), config.dump()) << yaml;
}

}  // namespace
}  // namespace breccia
