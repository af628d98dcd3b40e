// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/drawing.hpp"

#include <algorithm>

#include "config/reader.hpp"

namespace breccia {

PluginChoice renderer_settings(const std::string& type, const std::vector<std::string>& overrides,
                               const PluginDirectory& plugins) {
  struct Config {
    PluginChoice renderer;
  };
  Schema<Config> schema;
  schema.param("renderer", &Config::renderer).kind("renderer").doc("settings of the renderer");
  std::vector<std::string> placed;
  for (const std::string& o : overrides) placed.push_back("renderer." + o);
  const std::string text = "renderer: {type: " + type + "}\n";
  return schema.load(read_config(text, "--renderer", schema.documentation().root, plugins, placed)).renderer;
}

std::optional<PluginChoice> usual_renderer(const std::vector<std::string>& overrides, const PluginDirectory& plugins,
                                           Host& host) {
  const std::vector<std::string> names = plugins.names("renderer");
  if (std::find(names.begin(), names.end(), "pictures") != names.end())
    return renderer_settings("pictures", overrides, plugins);
  if (!overrides.empty()) throw UserError("--set has no effect: the renderer `pictures` is not installed");
  host.warn("no charts: the renderer `pictures` is not installed");
  return {};
}

std::vector<std::filesystem::path> drawn(const std::string& what, const std::string& renderer, Refusal refusal,
                                         Host& host, const std::function<std::vector<std::filesystem::path>()>& draw) {
  const auto none = [&](const std::exception& e) {
    host.warn("no " + what + " by renderer `" + renderer + "`: " + e.what());
    return std::vector<std::filesystem::path>();
  };
  try {
    return draw();
  } catch (const Unavailable& e) { return none(e); } catch (const UserError& e) {
    if (refusal == Refusal::ends) throw;
    return none(e);
  }
}

}  // namespace breccia
