// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "breccia/contact_law.hpp"
#include "config/reader.hpp"
#include "run/law_check.hpp"

namespace breccia {
namespace {

std::string example_section(const Registry& registry, const std::string& law) {
  const ParamSpec& root = registry.documentation(ContactLaw::kind, law).root;
  std::string text = "contact_law:\n  type: " + law + "\n";
  const auto chosen = [&](const std::string& name) {
    for (const auto& group : root.exactly_one_of)
      if (std::find(group.begin(), group.end(), name) != group.end()) return group.front() == name;
    return false;
  };
  for (const ParamSpec& p : root.members)
    if (p.fallback.is_null() && !p.example.empty() && (p.required || chosen(p.name)))
      text += "  " + p.name + ": " + p.example + "\n";
  return text;
}

struct LawSection {
  PluginChoice contact_law;
};

}  // namespace

PluginChoice example_law(const Registry& registry, const std::string& law, const std::vector<std::string>& parameters) {
  Schema<LawSection> schema;
  schema.param("contact_law", &LawSection::contact_law).kind("contact_law").doc("the law");
  std::vector<std::string> overrides;
  for (const std::string& p : parameters) overrides.push_back(p.starts_with("contact_law.") ? p : "contact_law." + p);
  const Json config = read_config(example_section(registry, law), "contact_law/" + law, schema.documentation().root,
                                  registry, overrides);
  return schema.load(config).contact_law;
}

}  // namespace breccia
