// SPDX-License-Identifier: BSD-3-Clause
/// What `breccia new` writes, from an installation of Breccia to its own passing tests: by the commands that it prints,
/// in a clean folder, with nothing but find_package(Breccia).
#include <vector>

#include "fixture.hpp"

namespace breccia::test {
namespace {

const std::string cmake = "'" BRECCIA_CMAKE "'";

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// Installs the program, its plugins and the SDK, or a part of that.
fs::path installed(const Folder& folder, const std::string& options = "") {
  const fs::path prefix = folder / "prefix";
  run(cmake + " --install '" BRECCIA_BINARY_DIR "' --prefix '" + prefix.string() + "' " + options, folder / "install");
  return prefix;
}

/// The environment of an author whose compiler and programs are those of this build; nothing goes into their home.
std::string within(const Folder& folder) {
  return "cd '" + folder.path().string() + "' && export CXX='" BRECCIA_CXX_COMPILER "' BRECCIA_CACHE=cache PATH='" +
         fs::path(BRECCIA_CMAKE).parent_path().string() + "':\"$PATH\" && ";
}

/// The lines that it says to type.
std::vector<std::string> commands(const std::string& said) {
  std::vector<std::string> lines;
  std::istringstream in(said.substr(said.find("To build, check and run it:")));
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("  ")) lines.push_back(line.substr(2));
  return lines;
}

}  // namespace

TEST(NewProject, OfALawIsBuiltCheckedAndRunByTheCommandsThatItPrints) {
  const Folder folder;
  const fs::path prefix = installed(folder), project = folder / "my_law";
  run(within(folder) + "'" + (prefix / "bin/breccia").string() + "' new contact_law my_law", folder / "said");
  const auto lines = commands(read(folder / "said"));
  ASSERT_EQ(lines.size(), 5u) << read(folder / "said");
  std::string all = within(folder);
  for (const std::string& line : lines) all += line + " && ";
  run(all + "true", folder / "log");
  EXPECT_TRUE(has(read(folder / "log"), "100% tests passed, 0 tests failed out of 2")) << read(folder / "log");
  EXPECT_TRUE(fs::exists(project / "results/my_law/summary.json"));
  EXPECT_FALSE(has(read(project / "build/CMakeCache.txt"), "VTK")) << "an author's project needs no VTK";

  const std::string plugin = "BRECCIA_PLUGIN_PATH='" + (project / "build").string() + "' ";
  run(plugin + "'" + (prefix / "bin/breccia").string() + "' describe contact_law/my_law", folder / "described");
  EXPECT_TRUE(has(read(folder / "described"), "version: 0.1"));
  EXPECT_FALSE(has(read(folder / "described"), "licence")) << "nobody chose one";
}

TEST(NewProject, OfEveryOtherKindPassesItsOwnTests) {
  const Folder folder;
  const fs::path prefix = installed(folder);
  // One project around them: the compiler is looked at once. Unoptimised code is compiled fast.
  std::string around = "cmake_minimum_required(VERSION 3.25)\nproject(all LANGUAGES CXX)\nenable_testing()\n";
  for (const char* kind : {"packing", "protocol", "postprocessor", "output", "renderer", "search"}) {
    const std::string name = std::string("my_") + kind;
    run(within(folder) + "'" + (prefix / "bin/breccia").string() + "' new " + kind + " " + name, folder / "said");
    around += "add_subdirectory(" + name + ")\n";
  }
  write(folder / "CMakeLists.txt", around);
  run(within(folder) + cmake + " -S . -B build -DCMAKE_BUILD_TYPE=None -DCMAKE_PREFIX_PATH='" + prefix.string() +
          "' && " + cmake + " --build build -j 2 && '" BRECCIA_CTEST "' --test-dir build --output-on-failure",
      folder / "log");
  EXPECT_TRUE(has(read(folder / "log"), "100% tests passed, 0 tests failed out of 12")) << read(folder / "log");
}

TEST(NewProject, WithoutTheProgramItsTestsFailAndSayWhy) {
  const Folder folder;
  const fs::path prefix = installed(folder, "--component sdk");
  run(within(folder) + "'" BRECCIA_PROGRAM "' new contact_law my_law", folder / "said");
  run(within(folder) + "cd my_law && " + cmake + " -S . -B build -DCMAKE_PREFIX_PATH='" + prefix.string() + "'",
      folder / "log");
  EXPECT_TRUE(has(read(folder / "log"), "only Breccia's")) << read(folder / "log");
  EXPECT_TRUE(has(read(folder / "log"), "-DBRECCIA_PROGRAM=")) << read(folder / "log");
  EXPECT_THROW(run("'" BRECCIA_CTEST "' --test-dir '" + (folder / "my_law/build").string() + "'", folder / "log"),
               std::runtime_error);
}

}  // namespace breccia::test
