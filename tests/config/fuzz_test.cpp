// SPDX-License-Identifier: BSD-3-Clause
/// Damaged workflows are read or refused; nothing else happens. The random numbers are the same in every run.
#include <gtest/gtest.h>

#include <random>

#include "breccia/text_file.hpp"
#include "config/reader.hpp"
#include "config/writer.hpp"
#include "fake_workflow.hpp"

namespace breccia {
namespace {

class Mutator {
 public:
  std::string mutate(std::string text) {
    const int times = 1 + int(random_() % 3);
    for (int k = 0; k < times; ++k) once(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  void once(std::string& text) {
    static const std::string special = ":-[]{}#&*!|>'\"%@`,?\n\t ~<=.0123eE+\\\r\xC3\xFF";
    static const char* const words[] = {
        "<<: ", "*stiff", "&stiff ",      "---\n", "...\n", "? ",          ": ",          "- ",
        "null", ".nan",   "1e999",        "\"",    "\n  ",  "!!binary ",   "%YAML 1.2\n", "|2-\n",
        "type", "type: ", "{a: &a [*a]}", "[[[[",  "\\x",   "\xEF\xBB\xBF"};
    const std::size_t at = below(text.size());
    switch (random_() % 7) {
      case 0:
        if (!text.empty()) text[at] = special[below(special.size())];
        break;
      case 1:
        text.insert(at, 1, special[below(special.size())]);
        break;
      case 2:
        text.erase(at, 1 + below(20));
        break;
      case 3:
        text.insert(at, words[below(std::size(words))]);
        break;
      case 4:
        text.insert(below(text.size()), text.substr(at, below(60)));
        break;
      case 5:
        if (!text.empty()) text[at] = char(random_());
        break;
      case 6:
        text.resize(at);
        break;
    }
  }
  std::mt19937_64 random_{2026};
};

TEST(Fuzz, MutatedWorkflowsAreReadOrRefused) {
  const fake::Plugins plugins;
  Mutator mutator;
  int read = 0, refused = 0;
  for (int k = 0; k < 6000; ++k) {
    const std::string text = mutator.mutate(fake::valid), lines = plain_lines(text);  // a lone \r ends a line, too
    SCOPED_TRACE(text);
    try {
      const Json config = read_config(text, "/folder/workflow.yaml", fake::root(), plugins, {}, fake::rules);
      ++read;
      const std::string written = write_yaml(config, fake::root(), plugins);
      ASSERT_EQ(read_config(written, "/folder/workflow.yaml", fake::root(), plugins).dump(), config.dump()) << written;
    } catch (const ConfigError& error) {
      ++refused;
      for (const Problem& problem : error.problems()) {
        ASSERT_FALSE(problem.text.empty());
        ASSERT_GE(problem.line, 1);
        ASSERT_GE(problem.column, 1);
        ASSERT_LE(problem.line, 1 + std::count(lines.begin(), lines.end(), '\n'));
      }
    }
  }
  // Mutations that only ever break, or never do, would try nothing.
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

TEST(Fuzz, MutatedOverridesAreReadOrRefused) {
  const fake::Plugins plugins;
  Mutator mutator;
  for (int k = 0; k < 1500; ++k) {
    const std::string text = mutator.mutate("postprocessor[0].walls.1.point=[1 m, 2 mm, 3 cm]");
    SCOPED_TRACE(text);
    try {
      read_config(fake::valid, "/folder/workflow.yaml", fake::root(), plugins, {text}, fake::rules);
    } catch (const ConfigError& error) { ASSERT_FALSE(error.problems().empty()); }
  }
}

}  // namespace
}  // namespace breccia
