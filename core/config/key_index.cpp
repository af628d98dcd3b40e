// SPDX-License-Identifier: BSD-3-Clause
#include "config/section_reader.hpp"

namespace breccia {

namespace {

/// Looks for a key in the sections that this workflow has: all groups, and the plugins that it picks.
class KeySearch {
 public:
  KeySearch(const std::string& key, const std::string& not_this_section, const PluginDirectory& plugins)
      : key_(key), avoid_(not_this_section), plugins_(plugins) {}

  std::optional<std::string> search(const ParamSpec& group, const YamlNode* node, const std::string& path) {
    if (path != avoid_)
      for (const ParamSpec& member : group.members)
        if (member.name == key_) return path;
    for (const ParamSpec& member : group.members) {
      const YamlEntry* entry = node ? node->find(member.name) : nullptr;
      if (auto found = search_member(member, entry ? entry->value.get() : nullptr, member_path(path, member.name)))
        return found;
    }
    return {};
  }

 private:
  std::optional<std::string> search_member(const ParamSpec& spec, const YamlNode* node, const std::string& path) {
    if (spec.type == ParamType::group) return search(spec, node, path);
    if (spec.type == ParamType::plugin) return node ? search_plugin(spec.plugin_kind, *node, path) : std::nullopt;
    if (!node) return {};
    if (spec.type == ParamType::plugin_stack)
      return search_member(spec.as_given(node->kind == YamlNode::Kind::sequence), node, path);
    for (std::size_t k = 0; k < node->items.size(); ++k) {
      const YamlNode& item = *node->items[k];
      const std::string item_at = item_path(path, k);
      std::optional<std::string> found;
      if (spec.type == ParamType::group_list) found = search(spec, &item, item_at);
      if (spec.type == ParamType::plugin_list) found = search_plugin(spec.plugin_kind, item, item_at);
      if (found) return found;
    }
    return {};
  }

  std::optional<std::string> search_plugin(const std::string& kind, const YamlNode& node, const std::string& path) {
    const YamlEntry* type = node.find("type");
    if (!type || type->value->kind != YamlNode::Kind::scalar) return {};
    try {
      return search(plugins_.documentation(kind, type->value->text).root, &node, path);
    } catch (const UserError&) {
      return {};  // reported where the section itself is read
    }
  }

  const std::string& key_;
  const std::string& avoid_;
  const PluginDirectory& plugins_;
};

}  // namespace

std::optional<std::string> section_with_key(const std::string& key, const std::string& not_this_section,
                                            const ParamSpec& root, const YamlNode& tree,
                                            const PluginDirectory& plugins) {
  return KeySearch(key, not_this_section, plugins).search(root, &tree, "");
}

}  // namespace breccia
