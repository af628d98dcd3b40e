// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "breccia/contact_law.hpp"
#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "run/law_check.hpp"

namespace breccia::cli {
int check(const CheckArguments& a) {
  Console console(1);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  for (const auto& plugin : a.plugins) registry.add(plugin);
  const std::string kind = std::string(ContactLaw::kind) + "/";
  if (!a.plugin.starts_with(kind))
    throw UserError("what is checked is a contact law, contact_law/NAME, not `" + a.plugin + "`");
  const std::string name = a.plugin.substr(kind.size());
  const PluginInfo& info = registry.info(ContactLaw::kind, name);
  const PluginChoice law = example_law(registry, name, a.overrides);
  fmt::print("{} {} ({})\n", a.plugin, info.version, info.file.string());
  std::size_t failed = 0;
  for (const LawFinding& f : check_law(registry, law)) {
    fmt::print("{}  {}: {}\n", f.holds ? "    ok" : "FAILED", f.check, f.measured);
    if (!f.holds) fmt::print("          {}\n", f.mend);
    failed += !f.holds;
  }
  fmt::print("{}\n", failed == 0 ? "all holds" : fmt::format("{} of the checks failed", failed));
  return failed == 0 ? ok : bad_input;
}

}  // namespace breccia::cli
