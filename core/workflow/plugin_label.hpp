// SPDX-License-Identifier: BSD-3-Clause
/// How the plugins of a workflow's lists are told apart.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

/// What the workflow calls it; empty for a plugin without `name`.
std::string given_name(const PluginChoice& choice);
/// What its results go by: `gauges`, or `upper_gauges` with the name `upper`.
std::string result_label(const PluginChoice& choice);

}  // namespace breccia
