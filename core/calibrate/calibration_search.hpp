// SPDX-License-Identifier: BSD-3-Clause
/// What proposes the points of a calibration: the plugin that its file names, or the usual one, where it is installed.
#pragma once

#include "calibrate/calibration.hpp"

namespace breccia {

constexpr const char* usual_search = "kriging";

bool has_usual_search(const Registry& registry);

/// Where the file names the usual search and it is not installed: that its name is not known would say too little.
void refuse_missing_usual_search(const InputFile& file, const Registry& registry);

/// Its search with all parameters. UserError where there is none. The usual one is loaded here and not before: its
/// libraries are many, and the runs of a calibration, each a process that reads the file, do without.
PluginChoice search_of(const LoadedCalibration& loaded, const Registry& registry);

}  // namespace breccia
