// SPDX-License-Identifier: BSD-3-Clause
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/console.hpp"
#include "cli/plugin_name.hpp"
#include "cli/verbs.hpp"
#include "config/suggest.hpp"

namespace breccia::cli {
namespace {

constexpr const char* takes = "check takes KIND/NAME (see `breccia list`) or NAME";

void refuse_kind(const Registry& registry, const std::string& written) {
  const std::vector<std::string>& kinds = registry.kinds();
  if (std::find(kinds.begin(), kinds.end(), written) == kinds.end()) return;
  std::vector<std::string> full;
  for (const std::string& name : registry.names(written)) full.push_back(written + "/" + name);
  throw UserError("`" + written + "` is a kind of plugin, and one plugin is checked at a time: " +
                  (full.empty() ? "none of this kind was found" : "write one of " + list_of(full, 20)));
}

void print(const CheckFinding& f) {
  using Outcome = CheckFinding::Outcome;
  const char* outcome = f.outcome == Outcome::holds ? "    ok" : f.outcome == Outcome::fails ? "FAILED" : "not checked";
  fmt::print("{}  {}: {}\n", outcome, f.check, f.measured);
  if (f.outcome == Outcome::fails) fmt::print("          {}\n", f.mend);
}

}  // namespace

int check(const CheckArguments& a) {
  Console console(1);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  for (const auto& plugin : a.plugins) registry.add(plugin);
  refuse_kind(registry, a.plugin);
  const auto [kind, name] = plugin_named(registry, a.plugin, {}, takes);
  const PluginInfo& info = registry.info(kind, name);
  fmt::print("{}/{} {} ({})\n", kind, name, info.version, info.file.string());
  std::fflush(stdout);
  std::size_t failed = 0, unknown = 0;
  for (const CheckFinding& f : check_plugin(registry, kind, name, a.overrides, console)) {
    print(f);
    failed += f.outcome == CheckFinding::Outcome::fails;
    unknown += f.outcome == CheckFinding::Outcome::not_checked;
  }
  fmt::print("{}{}\n", failed == 0 ? "all holds" : fmt::format("{} of the checks failed", failed),
             unknown > 0 ? fmt::format(", not checked: {}", unknown) : "");
  return failed == 0 ? ok : bad_input;
}

}  // namespace breccia::cli
