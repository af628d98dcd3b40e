// SPDX-License-Identifier: BSD-3-Clause
#include "config/at_path.hpp"

#include <algorithm>
#include <span>

#include "config/distribution_spec.hpp"
#include "config/listed_plugin.hpp"
#include "config/yaml_tree.hpp"

namespace breccia {
namespace {

/// One step down; nullptr when it leads nowhere.
const Json* child(const Json& at, const std::string& name) {
  if (at.is_array()) {
    const auto index = item_index(name, at.size());
    return index ? &at[*index] : nullptr;
  }
  const auto found = at.is_object() ? at.find(name) : at.end();
  return found == at.end() ? nullptr : &*found;
}

class Descent {
 public:
  explicit Descent(const PluginDirectory& plugins) : plugins_(plugins) {}

  /// `spec` is the parameter of `value`.
  std::optional<ParamSpec> below(const ParamSpec& spec, const Json& value, std::span<const PathStep> steps) const {
    if (steps.empty()) return spec;
    const Json* inner = child(value, steps[0].name);
    if (!inner) return {};
    const auto rest = steps.subspan(1);
    switch (spec.type) {
      case ParamType::group:
        return member(spec, *inner, steps);
      case ParamType::plugin:
        return member(plugin(spec, value), *inner, steps);
      case ParamType::plugin_stack:
        return below(spec.as_given(value.is_array()), value, steps);
      case ParamType::plugin_list:
        if (rest.empty()) return one_of(spec, ParamType::plugin);
        if (const Json* own = child(*inner, rest[0].name)) return member(as_listed(plugin(spec, *inner)), *own, rest);
        return {};
      case ParamType::group_list:
      case ParamType::group_map:
        return below(one_of(spec, ParamType::group), *inner, rest);
      case ParamType::quantity_map:
        return below(one_of(spec, ParamType::quantity), *inner, rest);
      case ParamType::quantity:  // a mapping only where it scatters
        return member(distribution_spec(spec), *inner, steps);
      case ParamType::quantity_list:
      case ParamType::text_list:
        return rest.empty() ? std::optional(spec) : std::nullopt;
      default:
        return {};
    }
  }

 private:
  const ParamSpec& plugin(const ParamSpec& spec, const Json& section) const {
    return plugins_.documentation(spec.plugin_kind, section.at("type")).root;
  }
  std::optional<ParamSpec> member(const ParamSpec& group, const Json& inner, std::span<const PathStep> steps) const {
    const auto spec = std::find_if(group.members.begin(), group.members.end(),
                                   [&](const ParamSpec& m) { return m.name == steps[0].name; });
    if (spec == group.members.end()) return {};
    return below(*spec, inner, steps.subspan(1));
  }
  static ParamSpec one_of(const ParamSpec& several, ParamType type) {
    ParamSpec one = several;
    one.type = type;
    return one;
  }

  const PluginDirectory& plugins_;
};

}  // namespace

const Json* value_at(const Json& config, std::string_view path) {
  const Json* at = &config;
  for (const PathStep& step : split_path(path))
    if (at) at = child(*at, step.name);
  return at;
}

std::optional<ParamSpec> spec_at(const Json& config, const ParamSpec& root, const PluginDirectory& plugins,
                                 std::string_view path) {
  return Descent(plugins).below(root, config, split_path(path));
}

}  // namespace breccia
