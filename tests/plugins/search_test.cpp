// SPDX-License-Identifier: BSD-3-Clause
/// Where plugins are found, and which of two wins.
#include <array>

#include "fixture.hpp"
#include "plugin/registry.hpp"

namespace breccia::test {

static const std::string law_file = "breccia_contact_law.tiny.so";
static const std::vector<PluginFolder> nowhere;

TEST(Search, TheFirstFolderWinsAndTheOtherIsReported) {
  const Folder a, b;
  const fs::path first = write(a / law_file, built("tiny_contact_law"));
  const fs::path second = write(b / law_file, built("tiny_contact_law"));
  const Registry registry({{a.path(), ""}, {b.path(), ""}});
  EXPECT_EQ(registry.info("contact_law", "tiny").file, first);
  EXPECT_EQ(registry.warnings(), std::vector<std::string>{"contact_law `tiny` is there twice: " + first.string() +
                                                          " is used and hides " + second.string()});
  const Registry other({{b.path(), ""}, {a.path(), ""}});
  EXPECT_EQ(other.info("contact_law", "tiny").file, second);
}

TEST(Search, OneFileByTwoWaysIsNoDuplicate) {
  const Folder a, b;
  write(a / law_file, built("tiny_contact_law"));
  fs::create_symlink(a / law_file, b / law_file);
  const Registry registry({{a.path(), ""}, {b.path(), ""}, {a.path() / ".", ""}});
  EXPECT_TRUE(registry.warnings().empty());
}

TEST(Search, AnAddedFolderGoesBeforeTheSearchPath) {
  const Folder a, b;
  write(a / law_file, built("tiny_contact_law"));
  write(b / law_file, built("tiny_contact_law"));
  Registry registry({{a.path(), ""}});
  registry.add(b.path().string() + "/");
  EXPECT_EQ(registry.info("contact_law", "tiny").file, b / law_file);
  ASSERT_EQ(registry.warnings().size(), 1u);
}

TEST(Search, OfTwoAddedTheFirstWins) {
  const Folder a, b;
  write(a / "mine.so", built("tiny_contact_law"));
  write(b / law_file, built("tiny_contact_law"));
  Registry registry(nowhere);
  registry.add(a / "mine.so");
  registry.add(b.path());
  EXPECT_EQ(registry.info("contact_law", "tiny").file, a / "mine.so");
  ASSERT_EQ(registry.warnings().size(), 1u);
}

TEST(Search, AFileNamedItselfMayHaveAnyName) {
  const Folder folder;
  Registry registry(nowhere);
  registry.add(write(folder / "whatever.plugin", built("tiny_packing")));
  EXPECT_EQ(registry.names("packing"), std::vector<std::string>{"tiny"});
  EXPECT_EQ(registry.documentation("packing", "tiny").summary, "tiny tiny");
}

TEST(Search, WhatIsAddedMustBeThere) {
  const Folder folder;
  Registry registry(nowhere);
  EXPECT_EQ(refusal([&] { registry.add(folder / "none.so"); }),
            "plugin " + (folder / "none.so").string() + " cannot be read: there is no such file");
  EXPECT_EQ(
      refusal([&] { registry.add(folder.path()); }),
      "the folder " + folder.path().string() + " holds no plugin: plugins are files named breccia_<kind>.<name>.so");
}

TEST(Search, AMisnamedPluginInAFolderIsNotLoadedButPointedOut) {
  const Folder folder;
  const fs::path file = write(folder / "libmylaw.so", built("tiny_contact_law"));
  write(folder / "libother.so", built("other_symbol"));  // none of our business
  const std::string hint = "plugin " + file.string() +
                           " holds contact_law `tiny`, which is not found under this file name: name it "
                           "breccia_contact_law.tiny.so, or name the file itself under `plugins:`";
  const Registry registry({{folder.path(), ""}});
  EXPECT_TRUE(registry.names("contact_law").empty());
  EXPECT_EQ(refusal([&] { registry.info("contact_law", "tiny"); }),
            "no contact_law named `tiny`; known: none; searched: " + folder.path().string() + "; " + hint);
  ASSERT_EQ(registry.problems().size(), 1u);
  EXPECT_EQ(registry.problems()[0].text, hint);
  EXPECT_EQ(registry.problems()[0].file, file);

  Registry adding({{folder.path(), ""}});
  EXPECT_NE(refusal([&] { adding.add(folder.path()); }).find(hint), std::string::npos);
  adding.add(file);  // now it is found, and nothing is left to point out
  EXPECT_TRUE(adding.problems().empty());
}

TEST(Search, TheEnvironmentNamesFolders) {
  const Folder a, b;
  write(b / law_file, built("tiny_contact_law"));
  const Environment path("BRECCIA_PLUGIN_PATH", (a / "absent").string() + "::" + b.path().string());
  const Registry registry;
  EXPECT_EQ(registry.info("contact_law", "tiny").file, b / law_file);
  EXPECT_EQ(registry.warnings(), std::vector<std::string>{"BRECCIA_PLUGIN_PATH names " + (a / "absent").string() +
                                                          ", which is not a folder"});
}

/// What a command prints.
static std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::array<char, 256> part;
  while (std::fgets(part.data(), int(part.size()), pipe)) text += part.data();
  EXPECT_EQ(pclose(pipe), 0) << text;
  return text;
}

TEST(Search, TheProgramsOwnFoldersAreFoundAlsoThroughALink) {
  const Folder home, elsewhere;
  fs::create_directories(home / "bin");
  fs::copy_file(fs::path(BRECCIA_FIXTURES) / "list_plugins", home / "bin/breccia");
  write(home / "lib/breccia/breccia_contact_law.misbehaving.so", built("misbehaving"));
  write(home / ("bin/plugins/" + law_file), built("tiny_contact_law"));
  fs::create_symlink(home / "bin/breccia", elsewhere / "b");
  const std::string found = "misbehaving " + (home / "lib/breccia/breccia_contact_law.misbehaving.so").string() +
                            "\ntiny " + (home / ("bin/plugins/" + law_file)).string() + "\n";
  EXPECT_EQ(output_of((home / "bin/breccia").string()), found);
  EXPECT_EQ(output_of("cd / && " + (elsewhere / "b").string()), found);

  const fs::path own = write(elsewhere / law_file, built("tiny_contact_law"));
  const std::string with_environment =
      output_of("BRECCIA_PLUGIN_PATH=" + elsewhere.path().string() + " " + (elsewhere / "b").string());
  EXPECT_NE(with_environment.find("tiny " + own.string() + "\n"), std::string::npos) << with_environment;
}

TEST(Search, FileNamesAndKeys) {
  EXPECT_EQ(key_of_file_name("/a/breccia_contact_law.elastic_brittle.so"),
            (PluginKey{"contact_law", "elastic_brittle"}));
  EXPECT_EQ(plugin_file_name({"contact_law", "elastic_brittle"}), "breccia_contact_law.elastic_brittle.so");
  for (const char* other : {"breccia_contact_law.so", "breccia_.x.so", "breccia_a..so", "libx.so", "breccia_.so",
                            "breccia_a.b.so.1", "Breccia_a.b.so"})
    EXPECT_EQ(key_of_file_name(other), std::nullopt) << other;
}

}  // namespace breccia::test
