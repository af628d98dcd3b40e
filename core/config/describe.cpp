// SPDX-License-Identifier: BSD-3-Clause
#include "config/describe.hpp"

#include "config/shorthand.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

/// "a, b" from the non-empty parts.
std::string join(const std::vector<std::string>& parts, const char* between) {
  std::string all;
  for (const std::string& part : parts)
    if (!part.empty()) all += (all.empty() ? "" : between) + part;
  return all;
}

std::string items_text(const ParamSpec& spec) {
  const std::string low = std::to_string(spec.min_items), high = std::to_string(spec.max_items);
  if (spec.min_items == spec.max_items) return low + " items";
  if (spec.max_items != SIZE_MAX) return low + " to " + high + " items";
  return spec.min_items == 0 ? std::string() : "at least " + low + (spec.min_items == 1 ? " item" : " items");
}

/// "quantity [Pa]", "list of quantities [m], 3 items", "one contact_law".
std::string value_text(const ParamSpec& spec) {
  const std::string unit = " [" + (spec.unit == "1" ? "-" : spec.unit) + "]";
  switch (spec.type) {
    case ParamType::quantity:
      return (spec.unit == "1" ? "number" : "quantity" + unit) +
             (spec.per_bond ? ", or a distribution of which each bond draws" : "");
    case ParamType::quantity_list:
      return join({"list of " + (spec.unit == "1" ? "numbers" : "quantities" + unit), items_text(spec)}, ", ");
    case ParamType::text_list:
      return join({"list of texts", items_text(spec)}, ", ");
    case ParamType::group_list:
      if (const ParamSpec* key = shorthand_member(spec))
        return join({"list of mappings, or of their `" + key->name + "` alone", items_text(spec)}, ", ");
      return join({"list of mappings", items_text(spec)}, ", ");
    case ParamType::plugin:
      return "one " + spec.plugin_kind;
    case ParamType::plugin_stack:
      return "one " + spec.plugin_kind + ", or a list of them that add up";
    case ParamType::plugin_list:
      return join({"list of " + spec.plugin_kind + " plugins", items_text(spec)}, ", ");
    case ParamType::boolean:
      return "true or false";
    case ParamType::group:
      return "mapping";
    case ParamType::group_map:
      return "mapping of names to mappings";
    case ParamType::quantity_map:
      return "mapping of names to " + (spec.unit == "1" ? "numbers" : "quantities" + unit);
    case ParamType::free_form:
      return "mapping of anything";
    case ParamType::path:
      return "file";
    default:
      return type_name(spec.type);
  }
}

std::string need_text(const ParamSpec& spec) {
  if (!spec.fallback.is_null()) return "default " + default_text(spec);
  return spec.required ? "required" : "optional";
}

std::vector<std::string> rules_of(const ParamSpec& group) {
  std::vector<std::string> rules;
  for (const auto& names : group.exactly_one_of) rules.push_back("exactly one of " + join(names, ", "));
  for (const auto& names : group.at_most_one_of) rules.push_back("at most one of " + join(names, ", "));
  for (const auto& [name, hint] : group.removed) rules.push_back(name + " is no longer a parameter; " + hint);
  return rules;
}

void add_text(std::string& out, const ParamSpec& group, int indent) {
  const std::string pad(indent, ' ');
  for (const ParamSpec& p : group.members) {
    out += pad + p.name + "  (" + join({value_text(p), range_text(p), need_text(p)}, "; ") + ")\n";
    if (!p.doc.empty()) out += pad + "    " + p.doc + "\n";
    for (const Choice& choice : p.choices)
      out += pad + "    " + choice.name + (choice.doc.empty() ? "" : ": " + choice.doc) + "\n";
    if (!p.example.empty()) out += pad + "    for instance " + p.name + ": " + p.example + "\n";
    if (!p.source.empty()) out += pad + "    source: " + p.source + "\n";
    if (p.changes_section) {
      out += pad + "    " + p.members.front().name + ": " + p.members.front().doc + "; for instance " +
             p.members.front().example + "\n" + pad + "    and any of the parameters above\n";
    } else {
      add_text(out, p, indent + 4);
    }
  }
  for (const std::string& rule : rules_of(group)) out += pad + "rule: " + rule + "\n";
}

/// Markdown takes what follows a bare `<` for a tag and swallows it; in code it stands as it is.
std::string prose(const std::string& text) {
  std::string out;
  bool code = false;
  for (const char c : text) {
    code ^= c == '`';
    out += c == '<' && !code ? std::string("&lt;") : std::string(1, c);
  }
  return out;
}

/// A cell of a Markdown table: no line ends, no bare bars.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : prose(text))
    out += c == '|' ? std::string("\\|") : c == '\n' ? std::string(" ") : std::string(1, c);
  return out;
}

void add_rows(std::string& out, const ParamSpec& group, const std::string& prefix) {
  for (const ParamSpec& p : group.members) {
    std::vector<std::string> about{p.doc};
    for (const Choice& choice : p.choices) about.push_back("`" + choice.name + "`: " + choice.doc);
    if (!p.example.empty()) about.push_back("for instance `" + p.example + "`");
    if (!p.source.empty()) about.push_back("source: " + p.source);
    const std::string fallback = default_text(p);
    out += "| `" + prefix + p.name + "` | " + cell(value_text(p)) + " | " + cell(range_text(p)) + " | " +
           (fallback.empty() ? (p.required ? "required" : "optional") : cell("`" + fallback + "`")) + " | " +
           cell(join(about, "; ")) + " |\n";
    ParamSpec below = p;
    if (p.changes_section) below.members.resize(1);  // the others stand above
    add_rows(out, below,
             prefix + p.name +
                 (p.type == ParamType::group_list  ? "[]."
                  : p.type == ParamType::group_map ? ".NAME."
                                                   : "."));
  }
}

void add_rules(std::string& out, const ParamSpec& group, const std::string& prefix) {
  for (const std::string& rule : rules_of(group))
    out += "- " + (prefix.empty() ? "" : "`" + prefix + "`: ") + rule + "\n";
  for (const ParamSpec& p : group.members)
    if (!p.changes_section) add_rules(out, p, prefix.empty() ? p.name : prefix + "." + p.name);
}

Json bound_json(const Bound& bound) { return {{"value", bound.value}, {"inclusive", bound.inclusive}}; }

void add_members_json(Json& out, const ParamSpec& group);

Json param_json(const ParamSpec& p) {
  Json j = {{"name", p.name}, {"type", type_name(p.type)}};
  if (p.type == ParamType::quantity || p.type == ParamType::quantity_list) j["unit"] = p.unit;
  if (!p.doc.empty()) j["doc"] = p.doc;
  if (!p.source.empty()) j["source"] = p.source;
  if (!p.example.empty()) j["example"] = p.example;
  j["required"] = p.required;
  if (!p.fallback.is_null()) j["default"] = p.fallback;
  if (p.lower) j["lower"] = bound_json(*p.lower);
  if (p.upper) j["upper"] = bound_json(*p.upper);
  for (const Choice& choice : p.choices) j["choices"].push_back({{"name", choice.name}, {"doc", choice.doc}});
  if (p.min_items > 0) j["min_items"] = p.min_items;
  if (p.max_items != SIZE_MAX) j["max_items"] = p.max_items;
  if (!p.plugin_kind.empty()) j["plugin_kind"] = p.plugin_kind;
  if (p.per_bond) j["per_bond"] = true;
  if (p.changes_section) j["changes_section"] = true;
  if (!p.members.empty()) add_members_json(j, p);
  return j;
}

void add_members_json(Json& out, const ParamSpec& group) {
  out["parameters"] = Json::array();
  for (const ParamSpec& p : group.members) out["parameters"].push_back(param_json(p));
  if (!group.exactly_one_of.empty()) out["exactly_one_of"] = group.exactly_one_of;
  if (!group.at_most_one_of.empty()) out["at_most_one_of"] = group.at_most_one_of;
  if (!group.removed.empty()) out["removed"] = group.removed;
}

}  // namespace

std::string type_name(ParamType type) {
  switch (type) {
    case ParamType::quantity:
      return "quantity";
    case ParamType::quantity_list:
      return "quantity_list";
    case ParamType::integer:
      return "integer";
    case ParamType::boolean:
      return "boolean";
    case ParamType::text:
      return "text";
    case ParamType::choice:
      return "choice";
    case ParamType::path:
      return "path";
    case ParamType::group:
      return "group";
    case ParamType::group_list:
      return "group_list";
    case ParamType::plugin:
      return "plugin";
    case ParamType::plugin_list:
      return "plugin_list";
    case ParamType::plugin_stack:
      return "plugin_stack";
    case ParamType::free_form:
      return "free_form";
    case ParamType::text_list:
      return "text_list";
    case ParamType::group_map:
      return "group_map";
    case ParamType::quantity_map:
      return "quantity_map";
  }
  return {};
}

std::string range_text(const ParamSpec& spec) {
  std::vector<std::string> parts;
  if (spec.lower)
    parts.push_back((spec.lower->inclusive ? "at least " : "above ") + format_quantity(spec.lower->value, spec.unit));
  if (spec.upper)
    parts.push_back((spec.upper->inclusive ? "at most " : "below ") + format_quantity(spec.upper->value, spec.unit));
  return join(parts, ", ");
}

std::string default_text(const ParamSpec& spec) {
  const Json& value = spec.fallback;
  if (value.is_null()) return {};
  if (spec.type == ParamType::quantity && value.is_number()) return format_quantity(value.get<double>(), spec.unit);
  if (spec.type == ParamType::quantity_list && value.is_array()) {
    std::vector<std::string> items;
    for (const Json& item : value)
      items.push_back(item.is_number() ? format_quantity(item.get<double>(), spec.unit) : item.dump());
    return "[" + join(items, ", ") + "]";
  }
  if (value.is_object() && value.size() == 1 && value.contains("type"))
    return "type: " + value["type"].get<std::string>();
  return value.is_string() && !value.get_ref<const std::string&>().empty() ? value.get<std::string>() : value.dump();
}

std::string describe_text(const std::string& kind, const std::string& name, const Documentation& doc) {
  std::string out = kind + " " + name + ": " + doc.summary + "\n";
  if (!doc.source.empty()) out += "source: " + doc.source + "\n";
  if (!doc.licence.empty()) out += "licence: " + doc.licence + "\n";
  if (!doc.details.empty()) out += "\n" + doc.details + "\n";
  out += "\nparameters:" + std::string(doc.root.members.empty() ? " none" : "") + "\n";
  add_text(out, doc.root, 2);
  return out;
}

std::string describe_markdown(const std::string& kind, const std::string& name, const Documentation& doc) {
  std::string out = "### " + kind + " `" + name + "`\n\n" + prose(doc.summary) + "\n\n";
  if (!doc.details.empty()) out += prose(doc.details) + "\n\n";
  if (!doc.source.empty()) out += "Source: " + prose(doc.source) + ". ";
  if (!doc.licence.empty()) out += "Licence: " + doc.licence + ".";
  out += "\n\n";
  if (doc.root.members.empty()) return out + "No parameters.\n";
  out += "| parameter | value | range | default | meaning |\n|---|---|---|---|---|\n";
  add_rows(out, doc.root, "");
  std::string rules;
  add_rules(rules, doc.root, "");
  return rules.empty() ? out : out + "\n" + rules;
}

Json describe_json(const std::string& kind, const std::string& name, const Documentation& doc) {
  Json j = {{"kind", kind},           {"name", name},         {"summary", doc.summary},
            {"details", doc.details}, {"source", doc.source}, {"licence", doc.licence}};
  if (doc.licence.empty()) j["licence"] = nullptr;
  add_members_json(j, doc.root);
  return j;
}

}  // namespace breccia
