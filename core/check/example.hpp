// SPDX-License-Identifier: BSD-3-Clause
/// Configurations of a plugin that nobody wrote: by its declarations.
#pragma once

#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "plugin/registry.hpp"

namespace breccia {

/// What to write for a parameter of the plugin, as YAML in one line, where the check knows better than its default or
/// example.
using Preset = std::function<std::optional<std::string>(const ParamSpec&)>;

/// A configuration of the plugin: `parameters` ("friction=0.3"), then presets, its defaults and, for what has none, the
/// examples of its declarations; also of what the plugin's own rules then ask for. ConfigError when that does not do.
PluginChoice example_plugin(const Registry& registry, const std::string& kind, const std::string& name,
                            const std::vector<std::string>& parameters = {}, const Preset& preset = {});

/// Whether the user gave this member of the plugin's section, or something within it.
bool is_given(const std::vector<std::string>& parameters, const std::string& member);

/// The same configuration with every number drawn anew: within `decades` of it either way, at times, if `edges`, near
/// the ends of its range, and never outside.
Json drawn_config(const ParamSpec& root, const Json& config, std::mt19937_64& random, double decades, bool edges);

}  // namespace breccia
