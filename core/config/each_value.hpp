// SPDX-License-Identifier: BSD-3-Clause
/// A checked configuration beside its schema, value by value.
#pragma once

#include <functional>

#include "config/plugin_directory.hpp"

namespace breccia {

/// Calls `visit` for every value that is no group, plugin or list of these, in the order of `config`, with its path
/// ("walls[2].point"); it may change the value.
void each_value(Json& config, const ParamSpec& root, const PluginDirectory& plugins,
                const std::function<void(const ParamSpec& spec, const std::string& path, Json& value)>& visit);

}  // namespace breccia
