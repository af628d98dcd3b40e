// SPDX-License-Identifier: BSD-3-Clause
/// JSON Schema of workflows and studies, for completion and checking in editors.
#pragma once

#include "config/plugin_directory.hpp"

namespace breccia {

/// Draft 7, which editors' YAML support knows best. Describes the file as it is written (quantities are texts with a
/// unit), so it is looser than `read_config`: it knows no units, no ranges of quantities and no rules of plugins. A
/// plugin that cannot be loaded is admitted with any parameters.
///
/// When `root` has a member `base`, a file that gives it need not be complete: nothing is required of it but inside
/// list items, which are never merged. Of a plugin's section without `type`, whose plugin only the base names, nothing
/// is checked.
Json json_schema(const ParamSpec& root, const PluginDirectory& plugins, const std::string& title = "Breccia workflow");

}  // namespace breccia
