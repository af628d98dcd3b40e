// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "breccia/utf8.hpp"
#include "cli/command_model.hpp"
#include "cli/verbs.hpp"
#include "plugin/registry.hpp"
#include "scaffold/scaffold.hpp"

namespace breccia::cli {
namespace {

namespace fs = std::filesystem;

/// Where this program's package is, for CMake; empty where CMake looks by itself.
std::string prefix_option(const fs::path& prefix) {
  return prefix == "/usr" || prefix == "/usr/local" ? "" : " -DCMAKE_PREFIX_PATH=" + shell_word(prefix.string());
}

}  // namespace

int new_plugin(const NewArguments& a) {
  const Registry registry;
  const std::vector<std::string> taken = registry.names(a.kind);  // UserError for a kind that does not exist
  if (std::find(taken.begin(), taken.end(), a.name) != taken.end())
    throw UserError(fmt::format("there is a {}/{} already (`breccia describe {}/{}`): choose another name", a.kind,
                                a.name, a.kind, a.name));
  const fs::path folder = a.folder.empty() ? fs::path(a.name) : a.folder;
  const auto files = make_project({a.kind, a.name, folder}, template_folder());
  fmt::print("made {}:\n", printable(folder.string()));
  for (const fs::path& file : files) fmt::print("  {}\n", file.string());
  const fs::path prefix = (program_folder() / "..").lexically_normal().parent_path();
  const std::string option = prefix_option(prefix);
  const std::string program = option.empty() ? "breccia" : shell_word((program_folder() / "breccia").string());
  fmt::print("\nTo build, check and run it:\n\n");
  if (!fs::equivalent(folder, fs::current_path())) fmt::print("  cd {}\n", shell_word(folder.string()));
  fmt::print(
      "  cmake -S . -B build{}\n"
      "  cmake --build build\n"
      "  ctest --test-dir build --output-on-failure\n"
      "  {} run {}.yaml\n\n"
      "Then put your own into {}.cpp; README.md has the places for equations and sources.\n",
      option, program, a.name, a.name);
  return ok;
}

}  // namespace breccia::cli
