// SPDX-License-Identifier: BSD-3-Clause
#include "config/merge.hpp"

#include <algorithm>
#include <span>

#include "config/to_yaml.hpp"

namespace breccia {

namespace {

/// Drops from `mapping` the alternatives to what is given above it, as `is_given` says of a name.
template <class IsGiven>
void drop_alternatives(const ParamSpec& group, YamlNode& mapping, const IsGiven& is_given) {
  const auto drop = [&](const std::vector<std::string>& names) {
    if (std::none_of(names.begin(), names.end(), is_given)) return;
    std::erase_if(mapping.entries, [&](const YamlEntry& entry) {
      return !is_given(entry.key) && std::find(names.begin(), names.end(), entry.key) != names.end();
    });
  };
  std::for_each(group.exactly_one_of.begin(), group.exactly_one_of.end(), drop);
  std::for_each(group.at_most_one_of.begin(), group.at_most_one_of.end(), drop);
}

const std::string* plugin_type(const YamlNode& section) {
  const YamlEntry* type = section.find("type");
  return type && type->value->kind == YamlNode::Kind::scalar ? &type->value->text : nullptr;
}

class Merger {
 public:
  explicit Merger(const PluginDirectory& plugins) : plugins_(plugins) {}

  /// `spec` is nullptr where the schema knows nothing: below free forms and unknown keys.
  YamlPtr merge(const ParamSpec* spec, const YamlPtr& below, const YamlPtr& above) const {
    if (above->kind != YamlNode::Kind::mapping || below->kind == YamlNode::Kind::null) return above;
    const bool stacks = spec && spec->type == ParamType::plugin_stack;
    if (stacks && below->kind == YamlNode::Kind::sequence) return above;  // another list, or one instead of it
    const bool is_plugin = stacks || (spec && spec->type == ParamType::plugin);
    const bool is_section = is_plugin || (spec && spec->type == ParamType::group);
    // A section that is no mapping stays, so that the reader reports it where it was written.
    if (below->kind != YamlNode::Kind::mapping) return is_section ? below : above;
    const std::string* type_below = plugin_type(*below);
    const std::string* type = plugin_type(*above);
    if (is_plugin && type && type_below && *type != *type_below) return above;
    return merge_entries(group_of(spec, type ? *above : *below), *below, *above);
  }

  /// See `drop_replaced`.
  YamlPtr drop_replaced(const ParamSpec* spec, const YamlPtr& node, int on_top) const {
    if (!spec) return node;
    auto copy = std::make_shared<YamlNode>(*node);
    for (YamlPtr& item : copy->items) item = drop_replaced(spec, item, on_top);
    const ParamSpec* group = node->kind == YamlNode::Kind::mapping ? group_of(spec, *node) : nullptr;
    if (!group) return copy;
    drop_alternatives(*group, *copy, [&](const std::string& name) {
      const YamlEntry* entry = node->find(name);
      return entry && entry->value->place.source >= on_top;
    });
    for (YamlEntry& entry : copy->entries)
      entry.value = drop_replaced(member_of(group, entry.key), entry.value, on_top);
    return copy;
  }

  /// See `fill_defaults`.
  YamlPtr fill(const ParamSpec* spec, const YamlPtr& node, std::span<const PathStep> steps) const {
    if (!spec || steps.size() < 2) return node;
    auto copy = std::make_shared<YamlNode>(*node);
    if (node->kind == YamlNode::Kind::sequence) {
      if (const auto index = item_index(steps[0].name, node->items.size()))
        copy->items[*index] = fill(spec, node->items[*index], steps.subspan(1));
      return copy;
    }
    const ParamSpec* member =
        node->kind == YamlNode::Kind::mapping ? member_of(group_of(spec, *node), steps[0].name) : nullptr;
    if (!member) return node;
    if (!node->find(member->name)) {
      const bool is_other_plugin =
          (member->type == ParamType::plugin || member->type == ParamType::plugin_stack) && steps[1].name == "type";
      const bool is_list_or_filled =
          member->fallback.is_array() || (member->fallback.is_object() && !member->fallback.empty());
      if (is_other_plugin || !is_list_or_filled) return node;
      try {
        copy->entries.push_back({member->name, node->place, yaml_of(*member, member->fallback, plugins_, node->place)});
      } catch (const UserError&) {
        return node;  // of a plugin that nobody knows: reported where the section is read
      }
    }
    for (YamlEntry& entry : copy->entries)
      if (entry.key == member->name) entry.value = fill(member, entry.value, steps.subspan(1));
    return copy;
  }

 private:
  YamlPtr merge_entries(const ParamSpec* group, const YamlNode& below, const YamlNode& above) const {
    auto merged = std::make_shared<YamlNode>(below);
    merged->place = above.place;
    if (group) drop_alternatives(*group, *merged, [&](const std::string& name) { return above.find(name) != nullptr; });
    for (const YamlEntry& entry : above.entries) {
      const auto old = std::find_if(merged->entries.begin(), merged->entries.end(),
                                    [&](const YamlEntry& e) { return e.key == entry.key; });
      if (old == merged->entries.end()) merged->entries.push_back(entry);
      else *old = {entry.key, entry.place, merge(member_of(group, entry.key), old->value, entry.value)};
    }
    return merged;
  }

  static const ParamSpec* member_of(const ParamSpec* group, const std::string& name) {
    if (!group) return nullptr;
    const auto found = std::find_if(group->members.begin(), group->members.end(),
                                    [&](const ParamSpec& member) { return member.name == name; });
    return found == group->members.end() ? nullptr : &*found;
  }

  /// What may stand in a mapping that `spec` is of, or has in its list; nullptr where nobody knows.
  const ParamSpec* group_of(const ParamSpec* spec, const YamlNode& mapping) const {
    if (!spec) return nullptr;
    if (spec->type == ParamType::group || spec->type == ParamType::group_list) return spec;
    // Of the user's own names nothing excludes another; what stands below a name is a group that is merged as it is.
    if (spec->type == ParamType::group_map) return nullptr;
    const bool is_plugin = spec->type == ParamType::plugin || spec->type == ParamType::plugin_list ||
                           spec->type == ParamType::plugin_stack;
    const std::string* type = is_plugin ? plugin_type(mapping) : nullptr;
    return type ? plugin_group(spec->plugin_kind, *type) : nullptr;
  }

  const ParamSpec* plugin_group(const std::string& kind, const std::string& name) const {
    try {
      return &plugins_.documentation(kind, name).root;
    } catch (const UserError&) {
      return nullptr;  // reported where the section is read
    }
  }

  const PluginDirectory& plugins_;
};

}  // namespace

YamlPtr merge(const ParamSpec& spec, const YamlPtr& below, const YamlPtr& above, const PluginDirectory& plugins) {
  return Merger(plugins).merge(&spec, below, above);
}

YamlPtr drop_replaced(const ParamSpec& spec, const YamlPtr& tree, int on_top, const PluginDirectory& plugins) {
  return Merger(plugins).drop_replaced(&spec, tree, on_top);
}

YamlPtr fill_defaults(const ParamSpec& spec, const YamlPtr& tree, std::string_view path,
                      const PluginDirectory& plugins) {
  const std::vector<PathStep> steps = split_path(path);
  return Merger(plugins).fill(&spec, tree, steps);
}

}  // namespace breccia
