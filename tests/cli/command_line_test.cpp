// SPDX-License-Identifier: BSD-3-Clause
/// The manual page and the shells' completions against what the program itself says of its command line (`--help`).
#include <algorithm>
#include <regex>
#include <set>

#include "program.hpp"

namespace breccia::testing {

namespace {

using Words = std::set<std::string>;

/// First group of each match.
Words all_of(const std::string& text, const std::string& expression) {
  const std::regex e(expression);
  Words found;
  for (std::sregex_iterator at(text.begin(), text.end(), e), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

bool on_this_machine(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

class CommandLine : public Program {
 protected:
  Words verbs() const {
    const std::string help = call("--help").text;
    return all_of(help.substr(help.find("Subcommands:")), "\n  (\\w+) ");
  }
  /// As `--help` of the verb lists them, at the beginnings of lines.
  Words options(const std::string& verb) const {
    return all_of(call(verb + " --help").text, "\n  (?:-\\w,)?(--[\\w-]+)");
  }
  /// A script in the language of a shell.
  Result run_in(const std::string& shell, const std::string& script) const {
    write("script", script);
    return call("", shell + " script");  // which is given the program's name as an argument that it does not read
  }
  /// What bash would offer for the words, the last of which is being written.
  Words completed(std::vector<std::string> words) const {
    words.insert(words.begin(), program);
    std::string script = "source '" + (folder_ / "completion").string() + "'\nCOMP_WORDS=(";
    for (const std::string& w : words) script += "'" + w + "' ";
    script += ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
              "\n_breccia\n((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\n";
    write("completion", call("command-line bash").text);
    return all_of(run_in("bash", script).text, "([^\n]+)\n");
  }
};

}  // namespace

TEST_F(CommandLine, EveryVerbAndOptionIsInTheManualPage) {
  const std::string page = call("command-line man").text;
  const Words all = verbs();
  EXPECT_GE(all.size(), 10U);
  for (const std::string& verb : all) {
    const std::size_t at = page.find("\n.SS breccia " + verb + "\n");
    ASSERT_NE(at, std::string::npos) << verb;
    const std::string section = page.substr(at, page.find("\n.S", at + 1) - at);
    for (const std::string& option : options(verb)) {
      const std::string shown = "\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR";
      EXPECT_NE(section.find(shown), std::string::npos) << verb << " " << option;
    }
  }
  EXPECT_EQ(page.find("command\\-line"), std::string::npos) << "the verb for those who package is not shown";
}

TEST_F(CommandLine, TheManualPageIsInOrder) {
  if (!on_this_machine("groff")) GTEST_SKIP() << "groff is not installed (Debian package groff-base)";
  write("breccia.1", call("command-line man").text);
  const Result r = run_in("sh", "groff -man -Tutf8 -ww -z breccia.1");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.text, "");
}

TEST_F(CommandLine, BashCompletesVerbsAndTheirOptions) {
  EXPECT_EQ(completed({"desc"}), Words{"describe"});
  const Words first = completed({""});
  for (const std::string& verb : verbs()) {
    EXPECT_TRUE(first.contains(verb)) << verb;
    const Words offered = completed({verb, "--"});
    EXPECT_EQ(offered, options(verb)) << verb;
  }
  EXPECT_EQ(completed({"sweep", "study.yaml", "--col"}), Words{"--collect"});
}

TEST_F(CommandLine, BashCompletesPluginsAndChoices) {
  EXPECT_EQ(completed({"describe", "contact_law/elastic_b"}), Words{"contact_law/elastic_brittle"});
  EXPECT_EQ(completed({"describe", "workf"}), Words{"workflow"});
  EXPECT_EQ(completed({"check", "contact_law/visc"}), Words{"contact_law/viscous"});
  EXPECT_EQ(completed({"check", "--set", "friction=1", "contact_law/visc"}), Words{"contact_law/viscous"});
  EXPECT_EQ(completed({"list", "po"}), Words{"postprocessor"});
  EXPECT_EQ(completed({"drive", "elastic_b"}), Words{"elastic_brittle"});
  EXPECT_EQ(completed({"describe", "damage", "--format", ""}), (Words{"text", "markdown", "json"}));
  EXPECT_EQ(completed({"describe", "damage", "--format", "=", "j"}), Words{"json"});
  EXPECT_EQ(completed({"schema", "s"}), Words{"sweep"});
}

TEST_F(CommandLine, BashCompletesFilesByTheirEndings) {
  for (const char* name : {"my own.yaml", "my.csv", "my.h5", "my.txt"}) write(name, "");
  fs::create_directory(folder_ / "my_results");
  EXPECT_EQ(completed({"run", "my"}), (Words{"my own.yaml", "my_results"}));
  EXPECT_EQ(completed({"validate", "x.yaml", "my"}), (Words{"my own.yaml", "my_results"}));
  EXPECT_EQ(completed({"run", "--resume", "my"}), Words{"my_results"});
  EXPECT_EQ(completed({"run", "--output", "=", "my"}), Words{"my_results"});
  EXPECT_EQ(completed({"run", "x.yaml", "--from", "my"}), (Words{"my.h5", "my_results"}));
  EXPECT_EQ(completed({"drive", "viscous", "--path", "my"}), (Words{"my.csv", "my_results"}));
  EXPECT_EQ(completed({"run", "x.yaml", "--threads", ""}), Words{}) << "a number is nothing to offer files for";
}

TEST_F(CommandLine, ZshReadsItsCompletion) {
  if (!on_this_machine("zsh")) GTEST_SKIP() << "zsh is not installed";
  write("_breccia", call("command-line zsh").text);
  const Result r = run_in("sh", "zsh -n _breccia");
  EXPECT_EQ(r.code, 0) << r.text;
  EXPECT_EQ(r.text, "");
}

TEST_F(CommandLine, FishCompletes) {
  if (!on_this_machine("fish")) GTEST_SKIP() << "fish is not installed";
  write("breccia.fish", call("command-line fish").text);
  const auto offered = [&](const std::string& line) {
    const Result r = run_in("env HOME=$PWD fish --no-config", "source breccia.fish\nset -p PATH " +
                                                                  fs::path(program).parent_path().string() +
                                                                  "\ncomplete -C '" + line + "'\n");
    return all_of(r.text, "([^\t\n]+)[^\n]*\n");
  };
  EXPECT_EQ(offered("breccia desc"), Words{"describe"});
  EXPECT_EQ(offered("breccia describe contact_law/elastic_b"), Words{"contact_law/elastic_brittle"});
  EXPECT_EQ(offered("breccia describe damage --format j"), Words{"json"});
  EXPECT_EQ(offered("breccia sweep study.yaml --col"), Words{"--collect"});
  for (const char* name : {"my_own.yaml", "my.csv", "my.txt"}) write(name, "");
  fs::create_directory(folder_ / "my_results");
  EXPECT_EQ(offered("breccia run my"), (Words{"my_own.yaml", "my_results/"}));
  EXPECT_EQ(offered("breccia drive viscous --path my"), (Words{"my.csv", "my_results/"}));
}

TEST(Citation, NamesTheVersion) {
  EXPECT_NE(content(BRECCIA_SOURCE_DIR "/CITATION.cff").find("\nversion: " BRECCIA_VERSION "\n"), std::string::npos);
}

}  // namespace breccia::testing
