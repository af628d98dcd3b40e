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

/// What a thread is calling in a plugin, for as long as it lives: innermost() names a plugin that does not come back.
class AtWork {
 public:
  AtWork(const PluginId& called, std::string_view what) : plugin(called), doing(what), outer_(innermost_) {
    innermost_ = this;
  }
  ~AtWork() { innermost_ = outer_; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  /// Of the calling thread; null when it is in no plugin. May be asked by a signal handler.
  static const AtWork* innermost() { return innermost_; }

  const PluginId plugin;
  const std::string_view doing;

 private:
  const AtWork* outer_;
  static thread_local constinit const AtWork* innermost_;
};
inline thread_local constinit const AtWork* AtWork::innermost_ = nullptr;

/// What `f` returns. `doing` ("measuring") completes "failed while". Costs a few stores as long as nothing is thrown.
template <class F>
decltype(auto) calling(const PluginId& plugin, std::string_view doing, F&& f) {
  const AtWork here(plugin, doing);
  try {
    return std::forward<F>(f)();
  } catch (...) { rethrow_as_fault(plugin, doing); }
}

}  // namespace breccia
