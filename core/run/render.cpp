// SPDX-License-Identifier: BSD-3-Clause
#include "run/render.hpp"

namespace breccia {

std::vector<std::filesystem::path> render_all(const std::vector<PluginChoice>& renderers, const Registry& registry,
                                              const RenderRequest& request, Host& host) {
  std::vector<std::filesystem::path> made;
  for (const PluginChoice& choice : renderers) {
    try {
      const auto files = registry.create<Renderer>(choice)->render(request, host);
      made.insert(made.end(), files.begin(), files.end());
    } catch (const Unavailable& e) { host.warn("no pictures by renderer `" + choice.type + "`: " + e.what()); }
  }
  return made;
}

}  // namespace breccia
