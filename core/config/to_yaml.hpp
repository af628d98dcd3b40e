// SPDX-License-Identifier: BSD-3-Clause
/// The way back: a configuration as a YAML tree with units. Internal to the configuration.
#pragma once

#include "config/plugin_directory.hpp"
#include "config/yaml_tree.hpp"

namespace breccia {

/// What a user would have to write for `value`, which has the form that ParamType documents. Everything in it is at
/// `place`. Members that the schema does not know are kept, so that reading it again refuses them.
YamlPtr yaml_of(const ParamSpec& spec, const Json& value, const PluginDirectory& plugins, Place place = {});

}  // namespace breccia
