// SPDX-License-Identifier: BSD-3-Clause
/// A plugin as it is named on the command line.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/registry.hpp"

namespace breccia::cli {

/// Kind and name, of KIND/NAME or of a name that one kind alone has. `others`: what may be written instead, for "did
/// you mean"; `takes`: how a message ends that says what may be written.
std::pair<std::string, std::string> plugin_named(const Registry& registry, const std::string& written,
                                                 const std::vector<std::string>& others, const std::string& takes);

/// UserError with the plugins of that kind when a whole kind was written.
void refuse_a_kind(const Registry& registry, const std::string& written);

}  // namespace breccia::cli
