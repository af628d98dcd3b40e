// SPDX-License-Identifier: BSD-3-Clause
/// A renderer as the command line asks for it.
#pragma once

#include "config/reader.hpp"

namespace breccia::cli {

/// With its defaults, and each "path=value" of `overrides` in its section. ConfigError when these do not fit.
inline PluginChoice renderer_settings(const std::string& type, const std::vector<std::string>& overrides,
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

}  // namespace breccia::cli
