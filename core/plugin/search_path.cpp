// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/search_path.hpp"

#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <sstream>

namespace fs = std::filesystem;

namespace breccia {

fs::path program_folder() {
  std::error_code unknown;  // /proc may be absent: then there is no such place
  const fs::path program = boost::dll::program_location(unknown);
  return unknown ? fs::path() : program.parent_path();
}

std::vector<PluginFolder> default_plugin_folders() {
  constexpr const char* variable = "BRECCIA_PLUGIN_PATH";
  std::vector<PluginFolder> folders;
  const char* value = std::getenv(variable);
  std::istringstream parts(value ? value : "");
  for (std::string part; std::getline(parts, part, ':');)
    if (!part.empty()) folders.push_back({fs::absolute(part).lexically_normal(), variable});
  if (const fs::path program = program_folder(); !program.empty()) {
    folders.push_back({(program / "../lib/breccia").lexically_normal(), ""});
    folders.push_back({program / "plugins", ""});
  }
  return folders;
}

}  // namespace breccia
