// SPDX-License-Identifier: BSD-3-Clause
/// The one way into a plugin: whatever it throws comes out as an error that names it.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "breccia/error.hpp"

namespace breccia {

/// Went wrong in a plugin, which the text names.
class PluginFault : public UserError {
 public:
  using UserError::UserError;
};

struct PluginId {
  std::string_view kind, type;
  std::string_view name = {};  ///< by which the workflow tells it from others of its type; may be empty
  std::string_view file = {};  ///< may be empty
};

/// To be called while an exception is being handled. A PluginFault, unless it is one of those that callers tell apart:
/// Cancelled, CannotWrite (which names the file, and is nobody's fault), Unavailable of a renderer.
[[noreturn]] void rethrow_as_fault(const PluginId& plugin, std::string_view doing);

/// What `f` returns. `doing` ("measuring") completes "failed while". Costs nothing as long as nothing is thrown.
template <class F>
decltype(auto) calling(const PluginId& plugin, std::string_view doing, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (...) { rethrow_as_fault(plugin, doing); }
}

}  // namespace breccia
