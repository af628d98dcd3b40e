// SPDX-License-Identifier: BSD-3-Clause
/// `breccia new`: what it writes, and what it refuses with nothing changed. That its projects build and pass their own
/// tests: tests/plugins/new_project_test.cpp.
#include <set>

#include "program.hpp"

namespace breccia::testing {
namespace {

class New : public Program {
 protected:
  /// All that lies in the folder, names relative to it.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      names.insert(entry.path().lexically_relative(folder_).string());
    return names;
  }
  void expect_refused(const std::string& arguments, const std::string& why) const {
    const auto before = files();
    const Result r = call("new " + arguments);
    EXPECT_EQ(r.code, 2) << arguments << "\n" << r.text;
    EXPECT_NE(r.text.find(why), r.text.npos) << arguments << "\n" << r.text;
    EXPECT_EQ(std::count(r.text.begin(), r.text.end(), '\n'), 1) << "one line\n" << r.text;
    EXPECT_EQ(files(), before) << arguments;
  }
};

TEST_F(New, EveryKindIsACompleteProjectWithTheNamesPutIn) {
  for (const std::string kind :
       {"packing", "contact_law", "protocol", "postprocessor", "output", "renderer", "search"}) {
    const Result r = call("new " + kind + " of_mine2 --dir " + kind);
    ASSERT_EQ(r.code, 0) << r.text;
    const fs::path project = folder_ / kind;
    for (const char* file :
         {"CMakeLists.txt", ".gitignore", "README.md", "of_mine2.cpp", "of_mine2.yaml", "tests/of_mine2_test.cpp"}) {
      EXPECT_TRUE(fs::is_regular_file(project / file)) << kind << ": " << file;
      EXPECT_NE(r.text.find(std::string("  ") + file + "\n"), r.text.npos) << r.text;
    }
    for (const auto& entry : fs::recursive_directory_iterator(project)) {
      if (!entry.is_regular_file()) continue;
      const std::string text = content(entry.path());
      for (const char* left : {"new_plugin", "NewPlugin", "new_breccia", "SPDX", "BSD"})
        EXPECT_EQ(text.find(left), text.npos) << entry.path() << " has " << left;
    }
    const std::string source = content(project / "of_mine2.cpp"), readme = content(project / "README.md");
    EXPECT_NE(source.find("OfMine2"), source.npos);
    for (const char* place : {"## Symbols", "## Sources", "unit", "choose one"})
      EXPECT_NE(readme.find(place), readme.npos) << kind << ": " << place;
    EXPECT_NE(content(project / "of_mine2.yaml").find("build/breccia_" + kind + ".of_mine2.so"), std::string::npos);
  }
  for (const std::string& name : files()) EXPECT_EQ(name.find(".breccia-new"), name.npos) << name << " was left over";
}

TEST_F(New, TheFolderMayBeThereWhenItIsEmpty) {
  fs::create_directory(folder_ / "empty");
  const Result r = call("new packing grid --dir .", "cd empty &&");
  ASSERT_EQ(r.code, 0) << r.text;
  EXPECT_TRUE(fs::exists(folder_ / "empty/grid.cpp"));
  EXPECT_EQ(r.text.find("  cd "), r.text.npos) << "one stands there already\n" << r.text;
}

TEST_F(New, APlaceholderForANameIsAName) {
  ASSERT_EQ(call("new contact_law new_plugin_kind").code, 0);
  EXPECT_NE(content(folder_ / "new_plugin_kind/CMakeLists.txt").find("contact_law new_plugin_kind SOURCES"),
            std::string::npos);
}

TEST_F(New, RefusesWhatCannotBeAndChangesNothing) {
  write("file", "");
  fs::create_directory(folder_ / "full");
  write("full/mine.txt", "kept");
  expect_refused("contact_lw my_law", "no kind of plugin called `contact_lw`; did you mean `contact_law`?");
  expect_refused("contact_law elastic_brittle", "there is a contact_law/elastic_brittle already");
  expect_refused("contact_law MyLaw", "`MyLaw` cannot be the name of a plugin");
  expect_refused("contact_law MyLaw", "did you mean `my_law`?");
  expect_refused("contact_law my-law", "did you mean `my_law`?");
  expect_refused("contact_law my__law", "did you mean `my_law`?");
  expect_refused("contact_law _law", "did you mean `law`?");
  expect_refused("contact_law 3d_law", "begins with a letter");
  expect_refused("contact_law ../law", "lower-case letters");
  expect_refused("contact_law ''", "lower-case letters");
  expect_refused("contact_law double", "`double` cannot be the name of a plugin: it has a meaning in C++");
  expect_refused("contact_law state", "in the SDK");
  expect_refused("contact_law " + std::string(65, 'x'), "longer than 64 characters");
  expect_refused("contact_law my_law --dir full", "is not empty; nothing was changed");
  expect_refused("contact_law my_law --dir file", "no folder; choose another place");
  expect_refused("contact_law my_law --dir nowhere/my_law", "there is no folder");
  expect_refused("contact_law my_law --dir /proc/my_law", "cannot make the folder /proc/my_law");
  EXPECT_EQ(content(folder_ / "full/mine.txt"), "kept");
}

TEST_F(New, AFullDiskLeavesNothing) {
  const Result r = call("new contact_law my_law", "ulimit -f 1; trap '' XFSZ;");  // no file above 1 block
  EXPECT_EQ(r.code, 2) << r.text;
  EXPECT_NE(r.text.find("cannot write"), r.text.npos) << r.text;
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace breccia::testing
