// SPDX-License-Identifier: BSD-3-Clause
/// One contact of two particles along a prescribed path, by the law and the engine of a run.
#pragma once

#include <optional>

#include "breccia/services.hpp"
#include "drive/drive_path.hpp"
#include "drive/drive_request.hpp"
#include "plugin/registry.hpp"

namespace breccia {

struct DriveSettings {
  PluginStack law;
  double density = 2650;  // [kg/m3]
  int dimension = 3;
  double thickness = 1;                     ///< of discs [m]
  double radius_i = 1e-3, radius_j = 1e-3;  // [m]
  double gap = 0;                           ///< between the surfaces at the start; negative: overlap [m]
  bool bonded = true;
  double porosity = 0.25, coordination_number = 10;  ///< what the law is told of the specimen around the pair
  int steps = 200;                                   ///< equal increments between two way points, at least
  std::optional<PluginChoice> renderer;              ///< of the charts
};

/// What is asked for, of the workflow or the law that it names, without charts. UserError for what cannot be.
DriveSettings drive_settings(const DriveRequest& request, Registry& registry, Host& host);

/// Force over displacement in each direction in which the path moves; none without the renderer `pictures`.
std::optional<PluginChoice> drive_charts(const DrivePath& path, const Registry& registry, Host& host);

/// Follows the path and writes curves.csv, summary.json and charts into `folder`, which is empty. Returns the files.
///
/// Both particles are held, so nothing oscillates. Without times in the path each increment takes 10^9 critical steps:
/// forces that depend on rates vanish. With times all increments take equally long, so that the longer of two ways
/// between way points has more of them. UserError for what the user can mend, before anything is written.
std::vector<std::filesystem::path> drive(const DriveSettings& settings, const DrivePath& path, const Registry& registry,
                                         const std::filesystem::path& folder, Host& host);

}  // namespace breccia
