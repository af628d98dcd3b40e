// SPDX-License-Identifier: BSD-3-Clause
#include "cli/plugin_name.hpp"

#include <algorithm>

#include "breccia/error.hpp"
#include "config/suggest.hpp"

namespace breccia::cli {

std::pair<std::string, std::string> plugin_named(const Registry& registry, const std::string& written,
                                                 const std::vector<std::string>& others, const std::string& takes) {
  if (const auto slash = written.find('/'); slash != std::string::npos)
    return {written.substr(0, slash), written.substr(slash + 1)};
  std::vector<std::string> found, known = registry.kinds();
  known.insert(known.end(), others.begin(), others.end());
  for (const std::string& kind : registry.kinds())
    for (const std::string& name : registry.names(kind)) {
      if (name == written) found.push_back(kind);
      known.push_back(name);
    }
  if (found.size() == 1) return {found[0], written};
  if (!found.empty()) {
    std::vector<std::string> full;
    for (const std::string& kind : found) full.push_back(kind + "/" + written);
    throw UserError("there is more than one plugin `" + written + "`: write one of " + list_of(full, 20));
  }
  const std::string near = closest(written, known);
  throw UserError("nothing is called `" + written + "`" + (near.empty() ? "" : "; did you mean `" + near + "`?") +
                  (near.empty() ? "; " : " ") + takes);
}

void refuse_a_kind(const Registry& registry, const std::string& written) {
  const std::vector<std::string>& kinds = registry.kinds();
  if (std::find(kinds.begin(), kinds.end(), written) == kinds.end()) return;
  std::vector<std::string> full;
  for (const std::string& name : registry.names(written)) full.push_back(written + "/" + name);
  throw UserError("`" + written + "` is a kind of plugin, and one plugin is checked at a time: " +
                  (full.empty() ? "none of this kind was found" : "write one of " + list_of(full, 20)));
}

}  // namespace breccia::cli
