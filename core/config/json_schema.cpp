// SPDX-License-Identifier: BSD-3-Clause
#include "config/json_schema.hpp"

#include <algorithm>

#include "config/describe.hpp"
#include "config/to_yaml.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

const char* const number_pattern = R"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?)";

class SchemaWriter {
 public:
  explicit SchemaWriter(const PluginDirectory& plugins) : plugins_(plugins) {}

  Json group(const ParamSpec& spec) const {
    Json schema = {{"type", "object"}};
    add_members(schema, spec);
    return schema;
  }

 private:
  void add_members(Json& schema, const ParamSpec& spec, const std::string& plugin_name = {}) const {
    Json properties = Json::object(), required = Json::array();
    if (!plugin_name.empty()) {
      properties["type"] = {{"const", plugin_name}};
      required.push_back("type");
    }
    for (const ParamSpec& member : spec.members) {
      properties[member.name] = value(member);
      if (member.required && member.fallback.is_null() && !is_alternative(spec, member.name))
        required.push_back(member.name);
    }
    schema["properties"] = properties;
    if (!required.empty()) schema["required"] = required;
    schema["additionalProperties"] = false;
    add_alternatives(schema, spec);
  }

  static bool is_alternative(const ParamSpec& spec, const std::string& name) {
    const auto names_it = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    return std::any_of(spec.exactly_one_of.begin(), spec.exactly_one_of.end(), names_it) ||
           std::any_of(spec.at_most_one_of.begin(), spec.at_most_one_of.end(), names_it);
  }

  static void add_alternatives(Json& schema, const ParamSpec& spec) {
    Json all = Json::array();
    const auto forbid_pairs = [&](const std::vector<std::string>& names) {
      for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t j = i + 1; j < names.size(); ++j)
          all.push_back({{"not", {{"required", Json::array({names[i], names[j]})}}}});
    };
    for (const auto& names : spec.exactly_one_of) {
      forbid_pairs(names);
      const bool has_default = std::any_of(spec.members.begin(), spec.members.end(), [&](const ParamSpec& m) {
        return !m.fallback.is_null() && std::find(names.begin(), names.end(), m.name) != names.end();
      });
      if (has_default) continue;
      Json any = Json::array();
      for (const std::string& name : names) any.push_back({{"required", Json::array({name})}});
      all.push_back({{"anyOf", any}});
    }
    for (const auto& names : spec.at_most_one_of) forbid_pairs(names);
    if (!all.empty()) schema["allOf"] = all;
  }

  Json value(const ParamSpec& spec) const {
    Json schema = bare_value(spec);
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

  Json bare_value(const ParamSpec& spec) const {
    switch (spec.type) {
      case ParamType::quantity: return quantity(spec);
      case ParamType::quantity_list: return list(quantity(spec), spec);
      case ParamType::integer: return integer(spec);
      case ParamType::boolean: return {{"type", "boolean"}};
      case ParamType::text: return {{"type", Json::array({"string", "number", "boolean"})}};
      case ParamType::path: return {{"type", Json::array({"string", "number"})}};
      case ParamType::choice: return choice(spec);
      case ParamType::group: return group(spec);
      case ParamType::group_list: return list(group(spec), spec);
      case ParamType::plugin: return plugin(spec);
      case ParamType::plugin_list: return list(plugin(spec), spec);
      case ParamType::free_form: return {{"type", "object"}};
    }
    return true;
  }

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

  Json plugin(const ParamSpec& spec) const {
    Json known = Json::array(), sections = Json::array();
    for (const std::string& name : plugins_.names(spec.plugin_kind)) {
      Json one = {{"const", name}}, section = {{"type", "object"}};
      try {
        const Documentation& doc = plugins_.documentation(spec.plugin_kind, name);
        one["description"] = doc.summary;
        add_members(section, doc.root, name);
      } catch (const UserError&) {
        // It does not load on this machine; that is told where it is used.
      }
      known.push_back(one);
      const Json is_it = {{"properties", {{"type", {{"const", name}}}}}, {"required", Json::array({"type"})}};
      sections.push_back({{"if", is_it}, {"then", section}});
    }
    // An empty anyOf or allOf is not valid: without plugins nothing is.
    if (known.empty()) return false;
    return {{"type", "object"},
            {"required", Json::array({"type"})},
            {"properties", {{"type", {{"anyOf", known}}}}},
            {"allOf", sections}};
  }

  const PluginDirectory& plugins_;
};

}  // namespace

Json json_schema(const ParamSpec& root, const PluginDirectory& plugins) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Breccia workflow"}};
  schema.update(SchemaWriter(plugins).group(root));
  return schema;
}

}  // namespace breccia
