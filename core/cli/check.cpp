// SPDX-License-Identifier: BSD-3-Clause
#include "check/check.hpp"

#include <fmt/format.h>

#include "cli/console.hpp"
#include "cli/plugin_name.hpp"
#include "cli/verbs.hpp"

namespace breccia::cli {
namespace {

constexpr const char* takes = "check takes KIND/NAME (see `breccia list`) or NAME";

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
  refuse_a_kind(registry, a.plugin);
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
