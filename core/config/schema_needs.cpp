// SPDX-License-Identifier: BSD-3-Clause
#include "config/schema_needs.hpp"

#include <algorithm>

#include "config/distribution_spec.hpp"

namespace breccia {

namespace {

bool names_it(const std::vector<std::vector<std::string>>& sets, const std::string& name) {
  return std::any_of(sets.begin(), sets.end(), [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  });
}

/// The keys that must be there, and to `all` one of each set of alternatives without a default.
void add_required(Json& schema, Json& all, const ParamSpec& spec) {
  Json required = Json::array();
  for (const ParamSpec& member : spec.members)
    if (member.required && member.fallback.is_null() && !names_it(spec.exactly_one_of, member.name) &&
        !names_it(spec.at_most_one_of, member.name))
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

Json if_mapping(Json needs) {
  return needs.empty() ? needs : Json{{"if", {{"type", "object"}}}, {"then", std::move(needs)}};
}

}  // namespace

Json SchemaNeeds::has_type(const std::string& name) {
  return {{"properties", {{"type", {{"const", name}}}}}, {"required", Json::array({"type"})}};
}

Json SchemaNeeds::of_member(const ParamSpec& member) {
  switch (member.type) {
    case ParamType::group:
      return of(member);
    case ParamType::group_map: {
      const Json item = of(member);
      return item.empty() ? item : Json{{"additionalProperties", item}};
    }
    case ParamType::quantity:
      return member.per_bond ? if_mapping(of(distribution_spec(member))) : Json();
    case ParamType::plugin:
      return of_plugin(member);
    case ParamType::plugin_stack:
      return if_mapping(of_plugin(member));
    default:
      return {};
  }
}

Json SchemaNeeds::of(const ParamSpec& group) {
  Json schema = Json::object(), all = Json::array(), sections = Json::object();
  add_required(schema, all, group);
  // A change of a section is laid over it: what stands below a key may be in the section.
  if (!group.changes_section)
    for (const ParamSpec& member : group.members)
      if (const Json section = of_member(member); !section.empty()) sections[member.name] = section;
  if (!sections.empty()) schema["properties"] = sections;
  if (!all.empty()) schema["allOf"] = all;
  return schema;
}

Json SchemaNeeds::of_plugin(const ParamSpec& section) {
  return definitions_.ref(section.plugin_kind + "_is_whole", [&] {
    Json sections = Json::array();
    for (const std::string& name : plugins_.names(section.plugin_kind)) {
      try {
        const Json needs = of(plugins_.documentation(section.plugin_kind, name).root);
        if (!needs.empty()) sections.push_back({{"if", has_type(name)}, {"then", needs}});
      } catch (const UserError&) {
        // It does not load on this machine; that is told where it is used.
      }
    }
    Json schema = {{"required", Json::array({"type"})}};
    if (!sections.empty()) schema["allOf"] = sections;
    return schema;
  });
}

}  // namespace breccia
