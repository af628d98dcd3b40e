// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "report/html.hpp"
#include "report/quantity.hpp"
#include "report/run_parts.hpp"
#include "results/summary_keys.hpp"

namespace breccia::report {
namespace {

/// What the plugin says of its parameters; of one that is not to be had here, nothing.
const ParamSpec* parameters_of(const Registry& registry, const char* kind, const std::string& type) {
  try {
    return &registry.documentation(kind, type).root;
  } catch (const UserError&) { return nullptr; }
}

std::string meaning(const ParamSpec* spec, const std::string& name) {
  if (!spec) return {};
  for (const ParamSpec& member : spec->members)
    if (member.name == name) return member.doc;
  return {};
}

struct Line {
  std::string title, value, meaning;
};

/// Adds what can be told in one line each; a list or mapping within is told by its members.
void add_values(std::vector<Line>& lines, const Json& section, const ParamSpec* spec, const std::string& before) {
  for (const auto& [key, value] : section.items()) {
    if (key == "type") continue;
    const std::string text = value_text(value), title = before + readable(key);
    if (!text.empty()) lines.push_back({title, text, meaning(spec, key)});
    else if (value.is_object()) add_values(lines, value, nullptr, title + ": ");
    else if (value.is_array())
      for (std::size_t k = 0; k < value.size(); ++k)
        if (value[k].is_object()) add_values(lines, value[k], nullptr, title + " " + std::to_string(k + 1) + ": ");
  }
}

std::string parameters_table(const std::string& caption, const Json& section, const ParamSpec* spec) {
  if (!section.is_object()) return {};
  std::vector<Line> lines;
  add_values(lines, section, spec, "");
  const bool has_meanings = std::any_of(lines.begin(), lines.end(), [](const Line& l) { return !l.meaning.empty(); });
  Table table(caption);
  table.column("Parameter").column("Value");
  if (has_meanings) table.column("Meaning");
  for (const Line& l : lines) {
    std::vector<std::string> row{escaped(capital(l.title)), escaped(l.value)};
    if (has_meanings) row.push_back(escaped(l.meaning));
    table.row(row);
  }
  return table.html();
}

std::string plugin_table(const char* kind, const char* called, const Json& section, const Registry& registry) {
  if (!section.is_object()) return {};
  const std::string type = section.value("type", "");
  return parameters_table(std::string(called) + " " + type, section, parameters_of(registry, kind, type));
}

}  // namespace

std::string model_part(const RunFiles& run, const Registry& registry) {
  std::string out;
  const std::vector<Json> laws = run.laws();
  if (laws.size() > 1)
    out +=
        paragraph("The forces of " + std::to_string(laws.size()) + " contact laws add up on each pair of particles.");
  for (const Json& law : laws) out += plugin_table("contact_law", "Contact law", law, registry);
  const Json material = run.given("material").is_object() ? run.given("material") : run.given("materials");
  out += parameters_table("Material", material, nullptr);
  out += plugin_table("packing", "Packing", run.given("packing"), registry);
  out += plugin_table("protocol", "Test", run.given("protocol"), registry);
  out += parameters_table("Damping: coefficients of the local, non-viscous damping", run.given("damping"), nullptr);
  return out;
}

}  // namespace breccia::report
