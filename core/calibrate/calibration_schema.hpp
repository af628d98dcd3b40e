// SPDX-License-Identifier: BSD-3-Clause
/// The JSON Schema of calibrations.
#pragma once

#include "config/plugin_directory.hpp"

namespace breccia {

/// With the values of `set` as the workflow's own schema has them, and paths of parameters that some workflow can have.
/// Which plugins the workflows name is in other files: what suits one of the plugins is admitted.
Json calibration_json_schema(const PluginDirectory& plugins);

}  // namespace breccia
