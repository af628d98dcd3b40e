// SPDX-License-Identifier: BSD-3-Clause
#include "config/each_value.hpp"

#include <algorithm>

#include "config/distribution_spec.hpp"
#include "config/yaml_tree.hpp"

namespace breccia {

namespace {

class Walk {
 public:
  using Visit = std::function<void(const ParamSpec&, const std::string&, Json&)>;
  Walk(const PluginDirectory& plugins, const Visit& visit) : plugins_(plugins), visit_(visit) {}

  void members(const ParamSpec& group, const std::string& path, Json& values) const {
    for (const auto& entry : values.items()) {
      const std::string& key = entry.key();
      const auto spec =
          std::find_if(group.members.begin(), group.members.end(), [&](const ParamSpec& m) { return m.name == key; });
      if (spec != group.members.end()) member(*spec, member_path(path, key), entry.value());
    }
  }

 private:
  void member(const ParamSpec& spec, const std::string& path, Json& value) const {
    switch (spec.type) {
      case ParamType::group:
        return members(spec, path, value);
      case ParamType::plugin:
        return plugin(spec, path, value);
      case ParamType::plugin_stack:
        return member(spec.as_given(value.is_array()), path, value);
      case ParamType::group_map:
        for (const auto& [name, item] : value.items()) members(spec, member_path(path, name), value[name]);
        return;
      case ParamType::quantity_map: {
        ParamSpec one = spec;
        one.type = ParamType::quantity;
        for (const auto& [name, item] : value.items()) visit_(one, member_path(path, name), value[name]);
        return;
      }
      case ParamType::quantity:
        if (spec.per_bond && value.is_object()) return members(distribution_spec(spec), path, value);
        return visit_(spec, path, value);
      case ParamType::group_list:
        for (std::size_t k = 0; k < value.size(); ++k) members(spec, item_path(path, k), value[k]);
        return;
      case ParamType::plugin_list:
        for (std::size_t k = 0; k < value.size(); ++k) plugin(spec, item_path(path, k), value[k]);
        return;
      default:
        visit_(spec, path, value);
    }
  }
  void plugin(const ParamSpec& spec, const std::string& path, Json& value) const {
    if (value.is_object()) members(plugins_.documentation(spec.plugin_kind, value.at("type")).root, path, value);
  }

  const PluginDirectory& plugins_;
  const Visit& visit_;
};

}  // namespace

void each_value(Json& config, const ParamSpec& root, const PluginDirectory& plugins,
                const std::function<void(const ParamSpec&, const std::string&, Json&)>& visit) {
  Walk(plugins, visit).members(root, "", config);
}

}  // namespace breccia
