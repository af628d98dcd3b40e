// SPDX-License-Identifier: BSD-3-Clause
/// A checked configuration as the text of a workflow.
#pragma once

#include <string>

#include "config/plugin_directory.hpp"

namespace breccia {

/// A workflow with every default written out, in SI units and with the shortest numbers that keep all bits:
/// `read_config` turns it into the identical `config`. `config` must be a result of `read_config` for the same schema.
std::string write_yaml(const Json& config, const ParamSpec& root, const PluginDirectory& plugins);

}  // namespace breccia
