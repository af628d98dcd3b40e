// SPDX-License-Identifier: BSD-3-Clause
/// Whether a contact law is what it says: tried on single pairs, in all directions, against itself.
#pragma once

#include <string>
#include <vector>

#include "plugin/registry.hpp"

namespace breccia {

struct LawFinding {
  std::string check;  ///< "energy against work, shear"
  bool holds = true;
  std::string measured;  ///< what was found, in a few words
  std::string mend;      ///< what to look at when it does not hold
};

/// A configuration of the law: `parameters` ("friction=0.3"), its defaults and, for what has none, the examples of its
/// declarations. ConfigError when that does not do.
PluginChoice example_law(const Registry& registry, const std::string& law,
                         const std::vector<std::string>& parameters = {});

/// The law of that configuration (checked, SI) through all trials, in their order. Deterministic, but for the last one,
/// which takes its time. PluginFault where the law itself throws.
std::vector<LawFinding> check_law(const Registry& registry, const PluginChoice& law);

}  // namespace breccia
