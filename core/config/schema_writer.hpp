// SPDX-License-Identifier: BSD-3-Clause
/// The JSON Schema, piece by piece. Internal to the configuration.
#pragma once

#include <algorithm>
#include <optional>

#include "config/describe.hpp"
#include "config/distribution_spec.hpp"
#include "config/listed_plugin.hpp"
#include "config/quantity_schema.hpp"
#include "config/schema_needs.hpp"
#include "config/shorthand.hpp"
#include "config/to_yaml.hpp"
#include "config/units.hpp"

namespace breccia {

/// What may stand where; that all must be there is said apart (`SchemaNeeds`), as a part of a workflow lacks it.
class SchemaWriter {
 public:
  explicit SchemaWriter(const PluginDirectory& plugins) : plugins_(plugins), needs_(plugins, definitions_) {}

  Json root(const ParamSpec& spec) {
    const auto has = [&](const char* name) {
      return std::any_of(spec.members.begin(), spec.members.end(),
                         [&](const ParamSpec& member) { return member.name == name; });
    };
    Json schema = group(spec), all = schema.value("allOf", Json::array());
    if (has("variants")) {
      schema["properties"]["variants"]["additionalProperties"] =
          definitions_.ref("variant", [&] { return variant(spec); });
      for (const ParamSpec& member : spec.members)
        if (member.type == ParamType::plugin || member.type == ParamType::plugin_stack)
          add_types_of_variants(member, all);
    }
    const Json whole = needs_.of(spec);
    if (!has("base")) all.push_back(whole);
    if (!all.empty()) schema["allOf"] = all;
    if (has("base")) {
      schema["if"] = {{"not", {{"required", Json::array({"base"})}}}};
      schema["then"] = whole;
    }
    schema["definitions"] = definitions_.all();
    return schema;
  }

  /// Of a value, without what is said about it.
  Json bare_value(const ParamSpec& spec) {
    switch (spec.type) {
      case ParamType::quantity:
        if (!spec.per_bond) return quantity_schema(spec, definitions_);
        return {{"anyOf", Json::array({quantity_schema(spec, definitions_), group(distribution_spec(spec))})}};
      case ParamType::quantity_list:
        return list(quantity_schema(spec, definitions_), spec);
      case ParamType::integer:
        return integer_schema(spec, definitions_);
      case ParamType::boolean:
        return {{"type", "boolean"}};
      case ParamType::text:
        return &spec == listed_name_ ? text(own_name) : text();
      case ParamType::text_list:
        return list(text(), spec);
      case ParamType::path:
        return {{"type", Json::array({"string", "number"})}, {"minLength", 1}};
      case ParamType::choice:
        return choice(spec);
      case ParamType::group:
        return group(spec);
      case ParamType::group_list:
        return list(list_item(spec), spec);
      case ParamType::plugin:
        return plugin(spec, false);
      case ParamType::plugin_list:
        return list(whole(plugin(spec, true), needs_.of_plugin(spec)), spec);
      case ParamType::plugin_stack: {
        const Json several = list(whole(plugin(spec, true), needs_.of_plugin(spec)), spec.as_given(true));
        Json one = {{"allOf", Json::array({plugin(spec, true)})}};
        if (all_take_names(spec)) one["not"] = {{"required", Json::array({name_in_list().name})}};
        return {{"if", {{"type", "array"}}}, {"then", several}, {"else", one}};
      }
      case ParamType::group_map:
        return map(group(spec), spec);
      case ParamType::quantity_map:
        return map(quantity_schema(spec, definitions_), spec);
      case ParamType::free_form:
        return {{"type", "object"}};
    }
    return true;
  }

  /// A section of any plugin of the kind. Without `type`, which a base may have, it must suit one of them.
  Json plugin(const ParamSpec& spec, bool listed) {
    return definitions_.ref(spec.plugin_kind + (listed ? "_in_list" : ""), [&]() -> Json {
      Json known = Json::array(), all = Json::array(), any = Json::array();
      for (const std::string& name : plugins_.names(spec.plugin_kind)) {
        Json one = {{"const", name}};
        if (const auto about = summary(spec.plugin_kind, name)) one["description"] = *about;
        known.push_back(one);
        const Json section = section_of(spec.plugin_kind, name, listed);
        all.push_back({{"if", SchemaNeeds::has_type(name)}, {"then", section}});
        any.push_back(section);
      }
      // An empty anyOf or allOf is not valid: without plugins nothing is.
      if (known.empty()) return {{"not", Json::object()}};
      all.push_back({{"if", {{"not", {{"required", Json::array({"type"})}}}}}, {"then", {{"anyOf", any}}}});
      return {{"type", "object"}, {"properties", {{"type", {{"anyOf", known}}}}}, {"allOf", all}};
    });
  }

  /// A part of a workflow, which has no variants of its own.
  Json variant(const ParamSpec& spec) {
    ParamSpec part = spec;
    std::erase_if(part.members, [](const ParamSpec& m) { return m.name == "base" || m.name == "variants"; });
    return group(part);
  }

  const SchemaDefinitions& definitions() const { return definitions_; }

 private:
  Json group(const ParamSpec& spec, const std::string& plugin = {}) {
    Json properties = Json::object();
    if (!plugin.empty()) properties["type"] = {{"const", plugin}};
    for (const ParamSpec& member : spec.members) properties[member.name] = value(member);
    Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (const Json all = exclusions(spec); !all.empty()) schema["allOf"] = all;
    return schema;
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

  Json value(const ParamSpec& spec) {
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

  static Json text(const char* pattern = nullptr) {
    Json schema = {{"type", Json::array({"string", "number", "boolean"})}};
    if (pattern) schema["pattern"] = pattern;
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

  static Json list(Json item, const ParamSpec& spec) {
    Json schema = {{"type", "array"}, {"items", std::move(item)}};
    if (spec.min_items > 0) schema["minItems"] = spec.min_items;
    if (spec.max_items != SIZE_MAX) schema["maxItems"] = spec.max_items;
    return schema;
  }

  static Json map(Json item, const ParamSpec& spec) {
    Json schema = {
        {"type", "object"}, {"propertyNames", {{"pattern", own_name}}}, {"additionalProperties", std::move(item)}};
    if (spec.min_items > 0) schema["minProperties"] = spec.min_items;
    return schema;
  }

  static Json whole(Json part, const Json& needs) {
    return needs.empty() ? part : Json{{"allOf", Json::array({std::move(part), needs})}};
  }

  /// A mapping, or the value of its only key. Items are never merged with those of a base: nothing may be missing.
  Json list_item(const ParamSpec& spec) {
    const Json item = whole(group(spec), needs_.of(spec));
    const ParamSpec* const only_key = shorthand_member(spec);
    return only_key ? Json{{"anyOf", Json::array({value(*only_key), item})}} : item;
  }

  std::optional<std::string> summary(const std::string& kind, const std::string& name) const {
    try {
      return plugins_.documentation(kind, name).summary;
    } catch (const UserError&) { return {}; }  // it does not load on this machine; that is told where it is used
  }

  Json section_of(const std::string& kind, const std::string& name, bool listed) {
    return definitions_.ref(kind + "_" + name + (listed ? "_in_list" : ""), [&]() -> Json {
      try {
        const ParamSpec& own = plugins_.documentation(kind, name).root;
        if (!listed) return group(own, name);
        const ParamSpec with_name = as_listed(own);
        listed_name_ = takes_name(own) ? &with_name.members.front() : nullptr;
        return group(with_name, name);
      } catch (const UserError&) { return {{"type", "object"}}; }
    });
  }

  bool all_take_names(const ParamSpec& spec) const {
    const auto names = plugins_.names(spec.plugin_kind);
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      try {
        return takes_name(plugins_.documentation(spec.plugin_kind, name).root);
      } catch (const UserError&) { return false; }
    });
  }

  /// In a variant of a workflow that names its plugin a section without `type` is that plugin's.
  void add_types_of_variants(const ParamSpec& member, Json& all) {
    const bool listed = member.type == ParamType::plugin_stack;
    for (const std::string& name : plugins_.names(member.plugin_kind)) {
      Json has_it = SchemaNeeds::has_type(name), has_none = {{"not", {{"required", Json::array({"type"})}}}};
      has_it["type"] = has_none["type"] = "object";
      const Json section = {{"if", has_none}, {"then", section_of(member.plugin_kind, name, listed)}};
      all.push_back(
          {{"if", {{"properties", {{member.name, has_it}}}, {"required", Json::array({member.name})}}},
           {"then",
            {{"properties", {{"variants", {{"additionalProperties", {{"properties", {{member.name, section}}}}}}}}}}}});
    }
  }

  /// A name that the user chooses, as `SectionReader` has it.
  static constexpr const char* own_name = R"(^(?!\.)[^\x00-,./:-@\[-^`{-\x7f]+$)";

  const PluginDirectory& plugins_;
  SchemaDefinitions definitions_;
  SchemaNeeds needs_;
  const ParamSpec* listed_name_ = nullptr;  ///< the `name` of the plugin that is being written
};

}  // namespace breccia
