// SPDX-License-Identifier: BSD-3-Clause
/// What is more than one value: mappings by the user's own names, distributions, changes of a section.
#include <algorithm>

#include "config/distribution_spec.hpp"
#include "config/merge.hpp"
#include "config/result_name.hpp"
#include "config/section_reader.hpp"

namespace breccia {

/// The names become part of messages, curves and files.
Json SectionReader::read_map(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  ParamSpec item = spec;
  item.type = spec.type == ParamType::group_map ? ParamType::group : ParamType::quantity;
  item.required = true;
  if (node.entries.size() < spec.min_items)
    report(node.place, site.path, "is empty; at least one `NAME: ...` is needed");
  Json all = Json::object();
  for (const YamlEntry& entry : node.entries) {
    const Site here{member_path(site.path, entry.key), entry.place};
    const auto is_fine = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || static_cast<unsigned char>(c) > 127;
    };
    if (std::string why = why_not_a_file_name(entry.key);
        !why.empty() || !std::all_of(entry.key.begin(), entry.key.end(), is_fine))
      report(entry.place, here.path,
             "`" + entry.key + "` cannot be a name here" +
                 (why.empty() ? ": letters, digits, `_` and `-` are possible" : ", it " + why));
    all[entry.key] = read(item, *entry.value, here);
  }
  return all;
}

Json SectionReader::read_distribution(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  const std::size_t before = findings_.size();
  Json values = read_members(distribution_spec(spec), node, site);
  if (findings_.size() == before) add_issues(check_distribution(values), node, site);
  return values;
}

/// Each item is laid over the section it stands in, like a workflow over its base. What is wrong with the section
/// itself has been said there.
Json SectionReader::read_changes(const ParamSpec& list, const ParamSpec& group, const YamlNode& section,
                                 const YamlNode& node, const Site& site, std::string_view own_key) {
  if (node.kind != YamlNode::Kind::sequence) {
    report(node.place, site.path, "must be " + wanted_value(list));
    return nullptr;
  }
  ParamSpec rest = group, own;
  std::erase_if(rest.members, [&](const ParamSpec& m) { return m.name == list.name; });
  own.type = rest.type = ParamType::group;
  own.members.push_back(list.members.front());
  const std::string& key = own.members.front().name;
  auto below = std::make_shared<YamlNode>(section);
  std::erase_if(below->entries, [&](const YamlEntry& e) { return e.key == list.name; });

  const std::string section_path =
      site.path.substr(0, site.path.size() - std::min(site.path.size(), list.name.size() + 1));
  Json all = Json::array();
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    const YamlNode& item = *node.items[k];
    const Site here{item_path(site.path, k), item.place};
    if (!check_mapping(item, here, own)) continue;
    auto above = std::make_shared<YamlNode>(item), of = std::make_shared<YamlNode>(item);
    std::erase_if(above->entries, [&](const YamlEntry& e) { return e.key == key; });
    std::erase_if(of->entries, [&](const YamlEntry& e) { return e.key != key; });
    Json changed = read_members(own, *of, here);
    if (const YamlEntry* type = item.find(own_key); type && !own_key.empty())
      report(type->place, member_path(here.path, own_key), "cannot differ here: the parameters may, not the plugin");
    const std::size_t before = findings_.size();
    const Json values = read_members(rest, *merge(rest, below, above, plugins_), here, own_key);
    const auto is_said = [&](const Finding& f) {
      const std::string in_section = section_path + f.path.substr(std::min(here.path.size(), f.path.size()));
      return std::any_of(findings_.begin(), findings_.begin() + std::ptrdiff_t(before), [&](const Finding& old) {
        const bool is_there =
            old.place.source == f.place.source && old.place.line == f.place.line && old.place.column == f.place.column;
        return old.path == in_section ? is_there || old.text == f.text : is_there && old.text == f.text;
      });
    };
    findings_.erase(std::remove_if(findings_.begin() + std::ptrdiff_t(before), findings_.end(), is_said),
                    findings_.end());
    changed.update(values);
    all.push_back(std::move(changed));
  }
  return all;
}

/// The plugin's own rules hold for the changed sections, too.
void SectionReader::check_changes(const ParamSpec& group, const std::string& kind, const std::string& name,
                                  const Json& config, const YamlNode& node, const Site& site) {
  for (const ParamSpec& list : group.members) {
    if (!list.changes_section || !config.contains(list.name)) continue;
    const YamlNode& items = *node.find(list.name)->value;
    for (std::size_t k = 0; k < config[list.name].size(); ++k) {
      Json one = config[list.name][k];
      one.erase(list.members.front().name);
      const YamlNode& item = *items.items[k];
      add_issues(plugins_.check(kind, name, one), item, {item_path(member_path(site.path, list.name), k), item.place});
    }
  }
}

}  // namespace breccia
