// SPDX-License-Identifier: BSD-3-Clause
/// JSON Schema of workflows and studies, for completion and checking in editors.
#pragma once

#include "config/plugin_directory.hpp"

namespace breccia {

/// Draft 7, which editors' YAML support knows best. Describes the file as it is written (quantities are texts with a
/// unit) and says what `read_config` says as far as a schema can: units by their dimension, signs and shares, bounds of
/// plain numbers, names, which keys must be there and which exclude each other. It knows no bounds of what has a unit,
/// no rules of plugins and no other file. A plugin that cannot be loaded is admitted with any parameters. Spellings of
/// units that it cannot judge it admits.
///
/// When `root` has a member `base`, a file that gives it need not be complete: nothing is required of it but inside
/// list items, which are never merged. A plugin's section without `type`, whose plugin only the base names, must suit
/// one of the plugins. `variants` are parts of the same kind; their sections without `type` are those of the plugin
/// that the file names, if it does.
Json json_schema(const ParamSpec& root, const PluginDirectory& plugins, const std::string& title = "Breccia workflow");

/// Values of a workflow by their paths, as `--set` and studies have them: what each may be, by a pattern of its path.
struct ValuesByPath {
  Json of_path, definitions;
};
ValuesByPath json_schema_by_path(const ParamSpec& root, const PluginDirectory& plugins);

}  // namespace breccia
