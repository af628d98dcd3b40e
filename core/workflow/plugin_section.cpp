// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/plugin_section.hpp"

#include "config/reader.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> paths_in(const Json& section) {
  std::vector<fs::path> paths;
  for (const Json& item : section) paths.push_back(item.at("path").get<std::string>());
  return paths;
}

}  // namespace

std::vector<fs::path> plugin_paths(const BaseChain& chain, const std::vector<std::string>& overrides,
                                   const std::string& variant) {
  if (!chain.whole) return {};
  return paths_in(read_section(chain, workflow_schema(), "plugins", overrides, variant));
}

std::vector<fs::path> plugin_paths(const BaseChain& chain, const ValuesOnTop& on_top) {
  if (!chain.whole) return {};
  return paths_in(read_section(chain, workflow_schema(), "plugins", on_top));
}

}  // namespace breccia
