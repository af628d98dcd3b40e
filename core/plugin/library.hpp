// SPDX-License-Identifier: BSD-3-Clause
/// One plugin, loaded. What goes wrong inside it becomes a UserError that names it.
#pragma once

#include <memory>
#include <optional>

#include "breccia/plugin.hpp"
#include "plugin/plugin_file.hpp"

namespace breccia {

class PluginLibrary {
 public:
  /// Inspects the file, then loads it for good: objects of a plugin may outlive every registry, so that its code is
  /// never unloaded. `expected`: what its file name promises, if that is how it was found.
  PluginLibrary(const std::filesystem::path& file, const std::optional<PluginKey>& expected);

  const PluginInfo& info() const { return info_; }
  const Documentation& documentation() const;
  Issues check(const Json& config) const;
  std::unique_ptr<Plugin> create(const Json& config) const;
  /// For an object that is not of the class that its kind stands for.
  [[noreturn]] void refuse_class() const;

 private:
  template <class F>
  decltype(auto) call(const char* doing, F&& f) const;

  PluginInfo info_;
  const Factory* factory_ = nullptr;
};

}  // namespace breccia
