// SPDX-License-Identifier: BSD-3-Clause
#include "config/json_schema.hpp"

#include <algorithm>

#include "config/describe.hpp"
#include "config/distribution_spec.hpp"
#include "config/listed_plugin.hpp"
#include "config/shorthand.hpp"
#include "config/to_yaml.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

const char* const number_pattern = R"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)";

class SchemaWriter {
 public:
  explicit SchemaWriter(const PluginDirectory& plugins) : plugins_(plugins) {}

  Json root(const ParamSpec& spec) const {
    const auto is_base = [](const ParamSpec& member) { return member.name == "base"; };
    if (std::none_of(spec.members.begin(), spec.members.end(), is_base)) return group(spec, Extent::whole);
    Json schema = group(spec, Extent::part);
    schema["if"] = {{"not", {{"required", Json::array({"base"})}}}};
    schema["then"] = completeness(spec);
    return schema;
  }

 private:
  /// Whether what is required must be there, or may be in a base.
  enum class Extent { whole, part };

  Json group(const ParamSpec& spec, Extent extent) const {
    Json schema = {{"type", "object"}};
    add_members(schema, spec, extent);
    return schema;
  }

  void add_members(Json& schema, const ParamSpec& spec, Extent extent, const std::string& plugin_name = {}) const {
    Json properties = Json::object();
    if (!plugin_name.empty()) properties["type"] = {{"const", plugin_name}};
    for (const ParamSpec& member : spec.members) properties[member.name] = value(member, extent);
    schema["properties"] = properties;
    schema["additionalProperties"] = false;
    Json all = exclusions(spec);
    if (extent == Extent::whole) add_required(schema, all, spec);
    if (!all.empty()) schema["allOf"] = all;
  }

  /// What a part lacks of a whole: only which keys must be there, section by section.
  Json completeness(const ParamSpec& spec) const {
    Json schema = Json::object(), all = Json::array(), sections = Json::object();
    add_required(schema, all, spec);
    for (const ParamSpec& member : spec.members) {
      Json section;
      if (member.type == ParamType::group) section = completeness(member);
      if (member.type == ParamType::plugin) section = plugin_completeness(member);
      if (member.type == ParamType::plugin_stack)
        section = {{"if", {{"type", "object"}}}, {"then", plugin_completeness(member)}};
      if (!section.empty()) sections[member.name] = section;
    }
    if (!sections.empty()) schema["properties"] = sections;
    if (!all.empty()) schema["allOf"] = all;
    return schema;
  }

  Json plugin_completeness(const ParamSpec& spec) const {
    Json sections = Json::array();
    for (const std::string& name : plugins_.names(spec.plugin_kind)) {
      try {
        const Json section = completeness(plugins_.documentation(spec.plugin_kind, name).root);
        if (!section.empty()) sections.push_back({{"if", has_type(name)}, {"then", section}});
      } catch (const UserError&) {
        // As in `plugin`.
      }
    }
    Json schema = {{"required", Json::array({"type"})}};
    if (!sections.empty()) schema["allOf"] = sections;
    return schema;
  }

  static Json has_type(const std::string& name) {
    return {{"properties", {{"type", {{"const", name}}}}}, {"required", Json::array({"type"})}};
  }

  /// The keys that must be there, and to `all` one of each set of alternatives without a default.
  static void add_required(Json& schema, Json& all, const ParamSpec& spec) {
    Json required = Json::array();
    for (const ParamSpec& member : spec.members)
      if (member.required && member.fallback.is_null() && !is_alternative(spec, member.name))
        required.push_back(member.name);
    if (!required.empty()) schema["required"] = required;
    for (const auto& names : spec.exactly_one_of) {
      const bool has_default = std::any_of(spec.members.begin(), spec.members.end(), [&](const ParamSpec& m) {
        return !m.fallback.is_null() && std::find(names.begin(), names.end(), m.name) != names.end();
      });
      if (has_default) continue;
      Json any = Json::array();
      for (const std::string& name : names) any.push_back({{"required", Json::array({name})}});
      all.push_back({{"anyOf", any}});
    }
  }

  static bool is_alternative(const ParamSpec& spec, const std::string& name) {
    const auto names_it = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    return std::any_of(spec.exactly_one_of.begin(), spec.exactly_one_of.end(), names_it) ||
           std::any_of(spec.at_most_one_of.begin(), spec.at_most_one_of.end(), names_it);
  }

  /// No two of a set of alternatives.
  static Json exclusions(const ParamSpec& spec) {
    Json all = Json::array();
    const auto forbid_pairs = [&](const std::vector<std::string>& names) {
      for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = i + 1; j < names.size(); ++j)
          all.push_back({{"not", {{"required", Json::array({names[i], names[j]})}}}});
    };
    for (const auto& names : spec.exactly_one_of) forbid_pairs(names);
    for (const auto& names : spec.at_most_one_of) forbid_pairs(names);
    return all;
  }

  Json value(const ParamSpec& spec, Extent extent) const {
    Json schema = bare_value(spec, extent);
    std::string about = spec.doc;
    const auto add = [&](const std::string& text) { about += (about.empty() ? "" : "; ") + text; };
    if (spec.type == ParamType::quantity || spec.type == ParamType::quantity_list) add(dimension_name(spec.unit));
    if (const std::string range = range_text(spec); !range.empty()) add(range);
    if (!spec.source.empty()) add("source: " + spec.source);
    if (!about.empty()) schema["description"] = about;
    if (!spec.fallback.is_null()) schema["default"] = plain_json(*yaml_of(spec, spec.fallback, plugins_));
    if (!spec.example.empty()) schema["examples"] = Json::array({spec.example});
    return schema;
  }

  Json bare_value(const ParamSpec& spec, Extent extent) const {
    switch (spec.type) {
      case ParamType::quantity:
        if (!spec.per_bond) return quantity(spec);
        return {{"anyOf", Json::array({quantity(spec), group(distribution_spec(spec), extent)})}};
      case ParamType::quantity_list:
        return list(quantity(spec), spec);
      case ParamType::integer:
        return integer(spec);
      case ParamType::boolean:
        return {{"type", "boolean"}};
      case ParamType::text:
        return text();
      case ParamType::text_list:
        return list(text(), spec);
      case ParamType::path:
        return {{"type", Json::array({"string", "number"})}};
      case ParamType::choice:
        return choice(spec);
      case ParamType::group:
        return group(spec, extent);
      case ParamType::group_list:
        return list(list_item(spec), spec);
      case ParamType::plugin:
        return plugin(spec, extent);
      case ParamType::plugin_list:
        return list(plugin(spec, Extent::whole, true), spec);
      case ParamType::plugin_stack: {
        Json one = plugin(spec, extent);
        Json several = list(plugin(spec, Extent::whole), spec.as_given(true));
        return {{"if", {{"type", "array"}}}, {"then", several}, {"else", one}};
      }
      case ParamType::group_map:
        return {{"type", "object"}, {"additionalProperties", group(spec, extent)}};
      case ParamType::quantity_map:
        return {{"type", "object"}, {"additionalProperties", quantity(spec)}};
      case ParamType::free_form:
        return {{"type", "object"}};
    }
    return true;
  }

  /// A mapping, or the value of its only key.
  Json list_item(const ParamSpec& spec) const {
    const ParamSpec* const only_key = shorthand_member(spec);
    if (!only_key) return group(spec, Extent::whole);
    return {{"anyOf", Json::array({value(*only_key, Extent::whole), group(spec, Extent::whole)})}};
  }

  static Json text() { return {{"type", Json::array({"string", "number", "boolean"})}}; }

  /// Editors that follow YAML 1.1 see a text in `1e5`: pure numbers may be texts as well.
  static Json quantity(const ParamSpec& spec) {
    const std::string number = number_pattern;
    if (spec.unit != "1") return {{"type", "string"}, {"pattern", "^\\s*" + number + "\\s*[^\\s0-9,.].*$"}};
    return with_range(
        {{"type", Json::array({"number", "string"})}, {"pattern", "^\\s*" + number + "\\s*([^\\s0-9,.].*)?$"}}, spec);
  }

  /// `1e6` likewise.
  static Json integer(const ParamSpec& spec) {
    return with_range(
        {{"type", Json::array({"integer", "string"})}, {"pattern", "^[-+]?[0-9]+\\.?[0-9]*[eE]\\+?[0-9]+$"}}, spec);
  }

  static Json with_range(Json schema, const ParamSpec& spec) {
    if (spec.lower) schema[spec.lower->inclusive ? "minimum" : "exclusiveMinimum"] = spec.lower->value;
    if (spec.upper) schema[spec.upper->inclusive ? "maximum" : "exclusiveMaximum"] = spec.upper->value;
    return schema;
  }

  static Json list(Json item, const ParamSpec& spec) {
    Json schema = {{"type", "array"}, {"items", std::move(item)}};
    if (spec.min_items > 0) schema["minItems"] = spec.min_items;
    if (spec.max_items != SIZE_MAX) schema["maxItems"] = spec.max_items;
    return schema;
  }

  /// `const` with a text for each name: editors show it beside the name.
  static Json choice(const ParamSpec& spec) {
    Json any = Json::array();
    for (const Choice& c : spec.choices) {
      Json one = {{"const", c.name}};
      if (!c.doc.empty()) one["description"] = c.doc;
      any.push_back(one);
    }
    return {{"anyOf", any}};
  }

  Json plugin(const ParamSpec& spec, Extent extent, bool in_list = false) const {
    Json known = Json::array(), sections = Json::array();
    for (const std::string& name : plugins_.names(spec.plugin_kind)) {
      Json one = {{"const", name}}, section = {{"type", "object"}};
      try {
        const Documentation& doc = plugins_.documentation(spec.plugin_kind, name);
        one["description"] = doc.summary;
        add_members(section, in_list ? as_listed(doc.root) : doc.root, extent, name);
      } catch (const UserError&) {
        // It does not load on this machine; that is told where it is used.
      }
      known.push_back(one);
      sections.push_back({{"if", has_type(name)}, {"then", section}});
    }
    // An empty anyOf or allOf is not valid: without plugins nothing is.
    if (known.empty()) return {{"not", Json::object()}};
    Json schema = {{"type", "object"}, {"properties", {{"type", {{"anyOf", known}}}}}, {"allOf", sections}};
    if (extent == Extent::whole) schema["required"] = Json::array({"type"});
    return schema;
  }

  const PluginDirectory& plugins_;
};

}  // namespace

Json json_schema(const ParamSpec& root, const PluginDirectory& plugins, const std::string& title) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(SchemaWriter(plugins).root(root));
  return schema;
}

}  // namespace breccia
