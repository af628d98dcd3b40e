// SPDX-License-Identifier: BSD-3-Clause
/// Groups, lists and plugin sections.
#include <algorithm>

#include "config/listed_plugin.hpp"
#include "config/section_reader.hpp"
#include "config/shorthand.hpp"
#include "config/suggest.hpp"
#include "config/text.hpp"
#include "config/to_yaml.hpp"
#include "config/yaml_syntax.hpp"

namespace breccia {

namespace {

std::string joined(const std::vector<std::string>& names, const char* last) {
  std::string out;
  for (std::size_t k = 0; k < names.size(); ++k)
    out += (k == 0 ? "" : k + 1 == names.size() ? last : ", ") + in_ticks(names[k]);
  return out;
}

}  // namespace

Json SectionReader::read(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  if (node.kind == YamlNode::Kind::null) {
    report(site.place, site.path,
           "has no value; " + wanted_value(spec) + " is needed" + (spec.required ? "" : ", or leave the key out"));
    return nullptr;
  }
  switch (spec.type) {
    case ParamType::plugin_stack:
      return read(spec.as_given(node.kind == YamlNode::Kind::sequence), node, site);
    case ParamType::group:
      return check_mapping(node, site, spec) ? read_members(spec, node, site) : Json();
    case ParamType::plugin:
      return check_mapping(node, site, spec) ? read_plugin(spec, node, site, In::section) : Json();
    case ParamType::free_form:
      return check_mapping(node, site, spec) ? plain_json(node) : Json();
    case ParamType::group_map:
    case ParamType::quantity_map:
      return check_mapping(node, site, spec) ? read_map(spec, node, site) : Json();
    case ParamType::quantity:
      return spec.per_bond && node.kind == YamlNode::Kind::mapping ? read_distribution(spec, node, site)
                                                                   : read_scalar(spec, node, site);
    case ParamType::quantity_list:
    case ParamType::text_list:
    case ParamType::group_list:
    case ParamType::plugin_list:
      return read_list(spec, node, site);
    default:
      return read_scalar(spec, node, site);
  }
}

bool SectionReader::check_mapping(const YamlNode& node, const Site& site, const ParamSpec& spec) {
  if (node.kind == YamlNode::Kind::mapping) return true;
  std::string hint;
  if (node.kind == YamlNode::Kind::scalar) {
    const std::string spaced = with_space_after_colon(node.text);
    if (!spaced.empty()) hint = "; a space is missing after the colon: write " + in_ticks(spaced);
    else if (spec.type == ParamType::plugin) hint = "; write " + in_ticks("type: " + node.text) + " in it";
  }
  const std::string what = node.kind == YamlNode::Kind::sequence ? "a list" : "the value " + in_ticks(node.text);
  report(node.place, site.path, "must be " + wanted_value(spec) + ", not " + what + hint);
  return false;
}

Json SectionReader::read_members(const ParamSpec& group, const YamlNode& node, const Site& site,
                                 std::string_view own_key) {
  std::set<std::string> meant;
  check_known(group, node, site, own_key, meant);
  check_alternatives(group, node, site, meant);
  Json all = Json::object();
  for (const ParamSpec& member : group.members) {
    const std::string path = member_path(site.path, member.name);
    if (const YamlEntry* entry = node.find(member.name)) {
      all[member.name] = member.changes_section
                             ? read_changes(member, group, node, *entry->value, {path, entry->place}, own_key)
                             : read(member, *entry->value, {path, entry->place});
    } else if (is_decided_otherwise(group, member.name, node)) {
      continue;
    } else if (!member.fallback.is_null()) {
      // A default takes the same way as what the user writes: nested defaults are filled in, and nothing is unchecked.
      const Place place = place_of_absent(site);
      all[member.name] = read(member, *yaml_of(member, member.fallback, plugins_, place), {path, place});
    } else if (member.required && !meant.contains(member.name)) {
      report_missing(member, {path, place_of_absent(site)});
    }
  }
  return all;
}

/// Unknown and retired keys. `meant` receives the members that a misspelt key probably stands for.
void SectionReader::check_known(const ParamSpec& group, const YamlNode& node, const Site& site,
                                std::string_view own_key, std::set<std::string>& meant) {
  std::vector<std::string> names, free_names;
  for (const ParamSpec& member : group.members) {
    names.push_back(member.name);
    if (!node.find(member.name)) free_names.push_back(member.name);
  }
  for (const YamlEntry& entry : node.entries) {
    const std::string path = member_path(site.path, entry.key);
    if (entry.key == own_key || std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
    if (const auto gone = group.removed.find(entry.key); gone != group.removed.end()) {
      report(entry.place, path, "is no longer a parameter; " + gone->second);
      continue;
    }
    if (const std::string spaced = with_space_after_colon(entry.key); !spaced.empty()) {
      report(entry.place, site.path, "a space is missing after the colon: write " + in_ticks(spaced));
      meant.insert(spaced.substr(0, spaced.find(':')));
      continue;
    }
    const std::string near = closest(entry.key, free_names);
    if (const auto section = section_with_key(entry.key, site.path, root_, tree_, plugins_)) {
      report(entry.place, path,
             "does not belong here; " + in_ticks(entry.key) + " belongs " +
                 (section->empty() ? "at the top level" : "under " + in_ticks(*section)) +
                 (near.empty() ? "" : "; or did you mean " + in_ticks(near) + "?"));
    } else {
      meant.insert(near);
      report(entry.place, path, "is not a known parameter" + suggestion(entry.key, near.empty() ? names : free_names));
    }
  }
}

void SectionReader::check_alternatives(const ParamSpec& group, const YamlNode& node, const Site& site,
                                       const std::set<std::string>& meant) {
  const auto given = [&](const std::vector<std::string>& names) {
    std::vector<std::string> present;
    for (const std::string& name : names)
      if (node.find(name)) present.push_back(name);
    return present;
  };
  const auto refuse_several = [&](const std::vector<std::string>& names, const std::vector<std::string>& present) {
    report(node.find(present[1])->place, site.path,
           "give only one of " + joined(names, " and ") + ", not " + joined(present, " and "));
  };
  const auto has_default = [&](const std::string& name) {
    return std::any_of(group.members.begin(), group.members.end(),
                       [&](const ParamSpec& member) { return member.name == name && !member.fallback.is_null(); });
  };
  for (const auto& names : group.exactly_one_of) {
    const auto present = given(names);
    if (present.size() > 1) refuse_several(names, present);
    const auto answered = [&](const std::string& name) { return has_default(name) || meant.contains(name); };
    if (present.empty() && std::none_of(names.begin(), names.end(), answered))
      report(place_of_absent(site), site.path, "one of " + joined(names, " and ") + " must be given");
  }
  for (const auto& names : group.at_most_one_of)
    if (const auto present = given(names); present.size() > 1) refuse_several(names, present);
}

/// True for a member whose alternative was given: it needs no value, and its default does not apply.
bool SectionReader::is_decided_otherwise(const ParamSpec& group, const std::string& member,
                                         const YamlNode& node) const {
  const auto decided = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), member) != names.end() &&
           std::any_of(names.begin(), names.end(), [&](const std::string& name) { return node.find(name) != nullptr; });
  };
  if (std::any_of(group.at_most_one_of.begin(), group.at_most_one_of.end(), decided)) return true;
  for (const auto& names : group.exactly_one_of) {
    if (std::find(names.begin(), names.end(), member) == names.end()) continue;
    const auto found =
        std::find_if(group.members.begin(), group.members.end(), [&](const ParamSpec& m) { return m.name == member; });
    if (decided(names) || found->fallback.is_null()) return true;
  }
  return false;
}

void SectionReader::report_missing(const ParamSpec& member, const Site& site) {
  const std::string example = example_line(member);
  report(site.place, site.path,
         "is missing" + (member.doc.empty() ? "" : ": " + member.doc) +
             (example.empty() ? "" : "; for instance " + in_ticks(example)));
}

Json SectionReader::read_list(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  if (node.kind != YamlNode::Kind::sequence) {
    report(node.place, site.path,
           "must be " + wanted_value(spec) + ", not " +
               (node.kind == YamlNode::Kind::mapping ? "a mapping" : "the value " + in_ticks(node.text)));
    return nullptr;
  }
  const std::size_t count = node.items.size();
  if (count < spec.min_items || count > spec.max_items) {
    const std::string low = std::to_string(spec.min_items), high = std::to_string(spec.max_items);
    const std::string need = spec.min_items == spec.max_items ? low
                             : count < spec.min_items         ? "at least " + low
                                                              : "at most " + high;
    report(node.place, site.path,
           "must have " + need + (need == "1" || need.ends_with(" 1") ? " item" : " items") + ", not " +
               std::to_string(count));
  }
  ParamSpec item = spec;
  item.type = spec.type == ParamType::quantity_list ? ParamType::quantity
              : spec.type == ParamType::text_list   ? ParamType::text
              : spec.type == ParamType::group_list  ? ParamType::group
                                                    : ParamType::plugin;
  item.required = true;
  const ParamSpec* const only_key = shorthand_member(spec);
  Json all = Json::array();
  std::vector<Site> sites;
  for (std::size_t k = 0; k < count; ++k) {
    const YamlPtr& given = node.items[k];
    const Site item_site{item_path(site.path, k), given->place};
    sites.push_back(item_site);
    if (spec.type == ParamType::plugin_list && given->kind == YamlNode::Kind::mapping)
      all.push_back(read_plugin(item, *given, item_site, In::list));
    else all.push_back(read(item, only_key ? *written_out(*only_key, given) : *given, item_site));
  }
  if (spec.type == ParamType::plugin_list) check_twins(spec, all, sites);
  return all;
}

/// An item in its short form as the mapping that it stands for. `path:x.so`, which lacks a space, is left to the
/// reader of mappings, whose message says so.
YamlPtr SectionReader::written_out(const ParamSpec& only_key, const YamlPtr& item) {
  if (item->kind != YamlNode::Kind::scalar || (item->plain && item->text.starts_with(only_key.name + ":"))) return item;
  auto mapping = std::make_shared<YamlNode>();
  mapping->kind = YamlNode::Kind::mapping;
  mapping->place = item->place;
  mapping->entries.push_back({only_key.name, item->place, item});
  return mapping;
}

/// The name in `type:`, or null after a finding.
Json SectionReader::read_plugin_type(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  const std::vector<std::string> known = plugins_.names(spec.plugin_kind);
  const YamlEntry* type = node.find("type");
  const std::string path = member_path(site.path, "type");
  const std::string names =
      known.empty() ? "no " + spec.plugin_kind + " plugin was found" : "known here: " + list_of(known);
  if (!type) {
    report(place_of_absent(site), path, "is missing; it names the " + spec.plugin_kind + "; " + names);
    return nullptr;
  }
  const YamlNode& value = *type->value;
  if (value.kind != YamlNode::Kind::scalar) {
    report(value.kind == YamlNode::Kind::null ? type->place : value.place, path,
           "must be the name of a " + spec.plugin_kind + "; " + names);
    return nullptr;
  }
  if (std::find(known.begin(), known.end(), value.text) == known.end()) {
    const std::string near = closest(value.text, known);
    report(value.place, path,
           "no " + spec.plugin_kind + " is named " + in_ticks(value.text) +
               (near.empty() ? "" : "; did you mean " + in_ticks(near) + "?") + (near.empty() ? "; " : " ") + names);
    return nullptr;
  }
  return value.text;
}

Json SectionReader::read_plugin(const ParamSpec& spec, const YamlNode& node, const Site& site, In where) {
  const Json name = read_plugin_type(spec, node, site);
  if (name.is_null()) return nullptr;
  const std::size_t before = findings_.size();
  Json config;
  try {
    const ParamSpec& root = plugins_.documentation(spec.plugin_kind, name).root;
    config = read_members(where == In::list ? as_listed(root) : root, node, site, "type");
    if (where == In::list && takes_name(root)) check_name(node, config, site);
    if (findings_.size() == before) add_issues(plugins_.check(spec.plugin_kind, name, config), node, site);
    if (findings_.size() == before) check_changes(root, spec.plugin_kind, name, config, node, site);
  } catch (const UserError& error) {
    report(node.find("type")->value->place, member_path(site.path, "type"), error.what());
    return nullptr;
  }
  Json section = {{"type", name}};
  section.update(config);
  return section;
}

Place place_of(const YamlNode& node, const std::string& path, Place otherwise) {
  Place place = otherwise;
  const YamlNode* at = &node;
  for (const PathStep& step : split_path(path)) {
    if (step.name.empty()) continue;
    const YamlNode* next = nullptr;
    if (at->kind == YamlNode::Kind::sequence) {
      if (const auto index = item_index(step.name, at->items.size())) next = at->items[*index].get();
    } else if (const YamlEntry* entry = at->find(step.name)) {
      next = entry->value.get();
    }
    if (!next) break;
    place = next->place;
    at = next;
  }
  return place;
}

void SectionReader::add_issues(const Issues& issues, const YamlNode& node, const Site& site) {
  for (const Issue& issue : issues)
    report(place_of(node, issue.path, site.path.empty() ? node.place : site.place),
           issue.path.empty() ? site.path : member_path(site.path, issue.path), issue.text);
}

}  // namespace breccia
