// SPDX-License-Identifier: BSD-3-Clause
/// Values that a workflow may hold and that are most likely slips of a unit.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "config/plugin_directory.hpp"

namespace breccia {

/// Path and text of each value of the checked workflow `config` outside of what is plausible for its kind, with the
/// range in the text. `root`: the workflow's schema.
std::vector<std::pair<std::string, std::string>> implausible_values(const Json& config, const ParamSpec& root,
                                                                    const PluginDirectory& plugins);

}  // namespace breccia
