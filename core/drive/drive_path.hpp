// SPDX-License-Identifier: BSD-3-Clause
/// The prescribed motion of two particles against each other.
#pragma once

#include <filesystem>
#include <vector>

namespace breccia {

/// Everything since the start of the path, where all is zero. Of the second particle relative to the first.
struct WayPoint {
  double normal = 0;    ///< change of the distance of the centres, positive when they part [m]
  double shear = 0;     ///< at the contact point [m]
  double rotation = 0;  ///< about an axis in the contact plane, normal to the shear (bending) [rad]
  double twist = 0;     ///< about the line of centres [rad]
  double time = 0;      ///< [s]
};

struct DrivePath {
  std::vector<WayPoint> points;  ///< the start, then at least one more
  bool timed = false;            ///< the file says when; times then increase
};

/// Reads a CSV file: a header with `normal_m`, `shear_m`, `rotation_rad`, `twist_rad`, `time_s` in any order, each once
/// and at least one of the first four; one way point a row. A first row of zeros is the start itself. UserError with
/// file, line and what is wrong.
DrivePath read_drive_path(const std::filesystem::path& file);

}  // namespace breccia
