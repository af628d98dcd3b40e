// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "breccia/contact_law.hpp"
#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "config/reader.hpp"
#include "run/law_check.hpp"

namespace breccia::cli {
namespace {

struct LawSection {
  PluginChoice contact_law;
};

}  // namespace

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
  Schema<LawSection> schema;
  schema.param("contact_law", &LawSection::contact_law).kind("contact_law").doc("the law");
  std::vector<std::string> overrides;
  for (const std::string& o : a.overrides) overrides.push_back(o.starts_with("contact_law.") ? o : "contact_law." + o);
  const Json config =
      read_config(example_section(registry, name), a.plugin, schema.documentation().root, registry, overrides);
  fmt::print("{} {} ({})\n", a.plugin, info.version, info.file.string());
  std::size_t failed = 0;
  for (const LawFinding& f : check_law(registry, schema.load(config).contact_law)) {
    fmt::print("{}  {}: {}\n", f.holds ? "    ok" : "FAILED", f.check, f.measured);
    if (!f.holds) fmt::print("          {}\n", f.mend);
    failed += !f.holds;
  }
  fmt::print("{}\n", failed == 0 ? "all holds" : fmt::format("{} of the checks failed", failed));
  return failed == 0 ? ok : bad_input;
}

}  // namespace breccia::cli
