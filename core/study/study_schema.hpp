// SPDX-License-Identifier: BSD-3-Clause
/// The JSON Schema of studies.
#pragma once

#include "config/plugin_directory.hpp"

namespace breccia {

/// With the values of `fixed`, `grid` and `list` as the workflow's own schema has them. Which plugins a study's
/// workflow names is in another file: a value is admitted if it suits one of the plugins that have such a parameter.
Json study_json_schema(const PluginDirectory& plugins);

/// Adds to the definitions of `schema` what each value of a workflow may be. Returns which of them belongs to which
/// path: the `patternProperties` of an object of values by their paths.
Json define_values(Json& schema, const PluginDirectory& plugins);

}  // namespace breccia
