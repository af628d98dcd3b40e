// SPDX-License-Identifier: BSD-3-Clause
/// What the configuration needs to know of plugins. The loader implements it; the configuration never opens a library.
#pragma once

#include <string>
#include <vector>

#include "breccia/schema.hpp"

namespace breccia {

class PluginDirectory {
 public:
  virtual ~PluginDirectory() = default;
  /// All plugins of a kind ("contact_law"), sorted, without loading them.
  virtual std::vector<std::string> names(const std::string& kind) const = 0;
  /// UserError when there is no such plugin or when it cannot be loaded.
  virtual const Documentation& documentation(const std::string& kind, const std::string& name) const = 0;
  /// The plugin's own rules on a section that satisfies its documentation (without the member "type").
  virtual Issues check(const std::string& kind, const std::string& name, const Json& config) const = 0;
};

}  // namespace breccia
