// SPDX-License-Identifier: BSD-3-Clause
#include "run/plugin_section.hpp"

#include <yaml-cpp/yaml.h>

namespace breccia {

namespace fs = std::filesystem;

std::vector<fs::path> plugin_paths(const std::string& yaml_text, const fs::path& file) {
  std::vector<fs::path> paths;
  if (yaml_text.size() > (4u << 20)) return paths;
  try {
    const YAML::Node root = YAML::Load(yaml_text);
    if (!root.IsMap() || !root["plugins"] || !root["plugins"].IsSequence()) return paths;
    for (const YAML::Node& entry : root["plugins"]) {
      if (!entry.IsMap() || !entry["path"] || !entry["path"].IsScalar()) continue;
      paths.push_back(fs::absolute(file).parent_path() / entry["path"].Scalar());
    }
  } catch (const YAML::Exception&) {
    paths.clear();
  }
  return paths;
}

}  // namespace breccia
