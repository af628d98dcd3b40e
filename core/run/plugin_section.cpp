// SPDX-License-Identifier: BSD-3-Clause
#include "run/plugin_section.hpp"

namespace breccia {

namespace fs = std::filesystem;

std::vector<fs::path> plugin_paths(const BaseChain& chain) {
  std::vector<fs::path> paths;
  for (const InputFile& file : chain.files) {
    const YamlEntry* section = file.tree ? file.tree->find("plugins") : nullptr;
    if (!section) continue;
    for (const YamlPtr& item : section->value->items)
      if (const YamlEntry* path = item->find("path"); path && path->value->kind == YamlNode::Kind::scalar)
        paths.push_back(file.folder / path->value->text);
    break;
  }
  return paths;
}

}  // namespace breccia
