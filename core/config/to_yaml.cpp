// SPDX-License-Identifier: BSD-3-Clause
#include "config/to_yaml.hpp"

#include <algorithm>

#include "config/distribution_spec.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

class TreeWriter {
 public:
  TreeWriter(const PluginDirectory& plugins, Place place) : plugins_(plugins), place_(place) {}

  YamlPtr write(const ParamSpec& spec, const Json& value) const {
    switch (spec.type) {
      case ParamType::quantity:
        if (spec.per_bond && value.is_object()) return members(distribution_spec(spec), value);
        return value.is_number() ? quantity(spec, value) : as_it_stands(value);
      case ParamType::quantity_list:
        return list(value, [&](const Json& item) { return quantity(spec, item); });
      case ParamType::group:
        return members(spec, value);
      case ParamType::group_list:
        return list(value, [&](const Json& item) { return members(spec, item); });
      case ParamType::group_map:
        return map(value, [&](const Json& item) { return members(spec, item); });
      case ParamType::quantity_map:
        return map(value, [&](const Json& item) { return quantity(spec, item); });
      case ParamType::plugin:
        return plugin(spec, value);
      case ParamType::plugin_list:
        return list(value, [&](const Json& item) { return plugin(spec, item); });
      case ParamType::plugin_stack:
        return write(spec.as_given(value.is_array()), value);
      case ParamType::choice:
        return value.is_string() ? scalar(value.get<std::string>(), true) : as_it_stands(value);
      default:
        return as_it_stands(value);
    }
  }

 private:
  std::shared_ptr<YamlNode> make(YamlNode::Kind kind) const {
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->place = place_;
    return node;
  }
  YamlPtr scalar(std::string text, bool plain) const {
    auto node = make(YamlNode::Kind::scalar);
    node->text = std::move(text);
    node->plain = plain;
    return node;
  }
  YamlPtr quantity(const ParamSpec& spec, const Json& value) const {
    return value.is_number() ? scalar(format_quantity(value.get<double>(), spec.unit), true) : as_it_stands(value);
  }
  template <class Item>
  YamlPtr list(const Json& value, Item&& item) const {
    if (!value.is_array()) return as_it_stands(value);
    auto node = make(YamlNode::Kind::sequence);
    for (const Json& element : value) node->items.push_back(item(element));
    return node;
  }
  template <class Item>
  YamlPtr map(const Json& value, Item&& item) const {
    if (!value.is_object()) return as_it_stands(value);
    auto node = make(YamlNode::Kind::mapping);
    for (const auto& [key, element] : value.items()) node->entries.push_back({key, place_, item(element)});
    return node;
  }
  YamlPtr members(const ParamSpec& group, const Json& value, const char* own_key = "") const {
    if (!value.is_object()) return as_it_stands(value);
    auto node = make(YamlNode::Kind::mapping);
    for (const auto& entry : value.items()) {
      const std::string& key = entry.key();
      const Json& member = entry.value();
      if (key == own_key) continue;
      const auto spec =
          std::find_if(group.members.begin(), group.members.end(), [&](const ParamSpec& m) { return m.name == key; });
      node->entries.push_back({key, place_, spec == group.members.end() ? as_it_stands(member) : write(*spec, member)});
    }
    return node;
  }
  YamlPtr plugin(const ParamSpec& spec, const Json& value) const {
    if (!value.is_object() || !value.contains("type") || !value["type"].is_string()) return as_it_stands(value);
    const std::string type = value["type"];
    const auto known = plugins_.names(spec.plugin_kind);
    if (std::find(known.begin(), known.end(), type) == known.end()) return as_it_stands(value);
    auto node =
        std::make_shared<YamlNode>(*members(plugins_.documentation(spec.plugin_kind, type).root, value, "type"));
    node->entries.insert(node->entries.begin(), {"type", place_, scalar(type, true)});
    return node;
  }
  YamlPtr as_it_stands(const Json& value) const {
    if (value.is_object()) {
      auto node = make(YamlNode::Kind::mapping);
      for (const auto& [key, member] : value.items()) node->entries.push_back({key, place_, as_it_stands(member)});
      return node;
    }
    if (value.is_array()) return list(value, [&](const Json& item) { return as_it_stands(item); });
    if (value.is_null()) return make(YamlNode::Kind::null);
    if (value.is_string()) return scalar(value.get<std::string>(), false);
    return scalar(value.dump(), true);
  }

  const PluginDirectory& plugins_;
  Place place_;
};

}  // namespace

YamlPtr yaml_of(const ParamSpec& spec, const Json& value, const PluginDirectory& plugins, Place place) {
  return TreeWriter(plugins, place).write(spec, value);
}

}  // namespace breccia
