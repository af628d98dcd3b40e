// SPDX-License-Identifier: BSD-3-Clause
/// What a path leads to: "contact_law.0.friction", "walls[2].point".
#pragma once

#include <optional>
#include <string_view>

#include "config/plugin_directory.hpp"

namespace breccia {

/// The value in a checked configuration, or in any other JSON; nullptr when there is none. Items of lists count from 0;
/// what is no number names none.
const Json* value_at(const Json& config, std::string_view path);

/// The parameter of that value, as the schema `root` or the plugin that `config` picks there declares it. Within a list
/// of quantities it is that of the list; within a distribution a parameter of the distribution, in the unit of what
/// scatters. Nothing where no parameter stands: below a free form, at the `type` of a plugin, past the end of a list.
std::optional<ParamSpec> spec_at(const Json& config, const ParamSpec& root, const PluginDirectory& plugins,
                                 std::string_view path);

}  // namespace breccia
