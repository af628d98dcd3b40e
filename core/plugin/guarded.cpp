// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/guarded.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>

#include "breccia/atomic_file.hpp"
#include "config/text.hpp"
#include "plugin/out_of_memory.hpp"

namespace breccia {

namespace {

std::string who(const PluginId& p) {
  return fmt::format("{} `{}`{}", p.kind, p.type, p.name.empty() ? "" : " (" + in_ticks(p.name) + ")");
}

bool names_it(const std::string& text, const PluginId& p) {
  if (!p.name.empty()) return text.find(in_ticks(p.name)) != text.npos;
  return text.find(in_ticks(p.type)) != text.npos || text.find(fmt::format("{} {}", p.kind, p.type)) != text.npos;
}

}  // namespace

void rethrow_as_fault(const PluginId& plugin, std::string_view doing) {
  const auto failed = [&](std::string_view why) {
    return PluginFault(fmt::format("{} failed while {}: {}{}", who(plugin), doing, why,
                                   plugin.file.empty() ? "" : fmt::format(" (plugin {})", plugin.file)));
  };
  const auto said = [&](const std::exception& e) {
    const std::string text = e.what();
    return PluginFault(names_it(text, plugin) ? text : who(plugin) + ": " + text);
  };
  try {
    throw;
  } catch (const PluginFault&) {  // of another plugin, which this one has called through the host
    throw;
  } catch (const Cancelled&) { throw; } catch (const CannotWrite&) {
    throw;
  } catch (const Unavailable& e) {
    if (plugin.kind == "renderer") throw;  // goes on without pictures
    throw said(e);
  } catch (const UserError& e) {  // already written for the user
    throw said(e);
  } catch (const std::bad_alloc&) {
    throw failed(out_of_memory());
  } catch (const std::filesystem::filesystem_error& e) {
    throw failed(fmt::format("cannot use {}: {}", e.path1().string(), e.code().message()));
  } catch (const std::exception& e) {
    // Of a thread that cannot be had libraries tell in words of their own, which name a function.
    if (std::string_view(e.what()).find(std::strerror(EAGAIN)) == std::string_view::npos) throw failed(e.what());
    throw failed("the system gives no more threads, or has no memory for one (ulimit -u, -v, -d)");
  } catch (...) { throw failed("it threw something that is not an exception"); }
}

}  // namespace breccia
