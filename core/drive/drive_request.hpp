// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

/// A drive as a user asks for it; quantities with their units, empty ones for the default.
struct DriveRequest {
  std::string target;  ///< a workflow, or the name of a contact law
  std::filesystem::path path, output;
  std::vector<std::string> radius, overrides;
  std::string gap, porosity;
  double coordination_number = 10;
  int steps = 200;
  bool unbonded = false, overwrite = false;
};

}  // namespace breccia
