// SPDX-License-Identifier: BSD-3-Clause
#include "check/example.hpp"

#include <algorithm>
#include <cmath>

#include "config/reader.hpp"

namespace breccia {
namespace {

/// The registry, which remembers what the plugin's own rules said last.
class Noting final : public PluginDirectory {
 public:
  explicit Noting(const Registry& registry) : registry_(registry) {}
  std::vector<std::string> names(const std::string& kind) const override { return registry_.names(kind); }
  const Documentation& documentation(const std::string& kind, const std::string& name) const override {
    return registry_.documentation(kind, name);
  }
  Issues check(const std::string& kind, const std::string& name, const Json& config) const override {
    return issues = registry_.check(kind, name, config);
  }
  mutable Issues issues;

 private:
  const Registry& registry_;
};

/// What stands for a parameter without a default; empty when nothing is known.
std::string example_of(const ParamSpec& p) {
  if (!p.example.empty()) return p.example;
  if (p.type == ParamType::choice && !p.choices.empty()) return p.choices.front().name;
  if (p.type == ParamType::boolean) return "false";
  if (p.type != ParamType::group) return {};
  std::string text;
  for (const ParamSpec& m : p.members)
    if (m.required && m.fallback.is_null())
      if (const std::string value = example_of(m); !value.empty())
        text += (text.empty() ? "" : ", ") + m.name + ": " + value;
  return "{" + text + "}";
}

class Section {
 public:
  Section(const ParamSpec& root, const std::vector<std::string>& parameters, const Preset& preset)
      : root_(root), parameters_(parameters), preset_(preset) {}

  std::string text(const std::string& kind, const std::string& name, const std::vector<std::string>& more) const {
    std::string all = kind + ":\n  type: " + name + "\n";
    for (const ParamSpec& p : root_.members) {
      std::string value;
      if (const auto known = preset_of(p)) value = *known;
      else if (!p.fallback.is_null()) continue;
      else if ((p.required || is_chosen(p.name) || std::count(more.begin(), more.end(), p.name)) &&
               !is_left_out(p.name))
        value = example_of(p);
      if (!value.empty()) all += "  " + p.name + ": " + value + "\n";
    }
    return all;
  }

 private:
  std::optional<std::string> preset_of(const ParamSpec& p) const {
    if (!preset_ || is_left_out(p.name)) return {};
    const auto value = preset_(p);
    return value && value->empty() ? std::optional(example_of(p)) : value;
  }
  /// Another of a group of which only one is wanted is given.
  bool is_left_out(const std::string& name) const {
    for (const auto* groups : {&root_.exactly_one_of, &root_.at_most_one_of})
      for (const auto& group : *groups)
        if (std::count(group.begin(), group.end(), name))
          for (const std::string& other : group)
            if (other != name && is_given(parameters_, other)) return true;
    return false;
  }
  /// The first of a group of which one is wanted, unless another has a preset.
  bool is_chosen(const std::string& name) const {
    for (const auto& group : root_.exactly_one_of) {
      if (!std::count(group.begin(), group.end(), name)) continue;
      for (const ParamSpec& p : root_.members)
        if (p.name != name && std::count(group.begin(), group.end(), p.name) && preset_of(p)) return false;
      return group.front() == name;
    }
    return false;
  }

  const ParamSpec& root_;
  const std::vector<std::string>& parameters_;
  const Preset& preset_;
};

struct Wanted {
  PluginChoice plugin;
};

Json drawn(const ParamSpec& p, const Json& given, std::mt19937_64& random, double decades, bool edges) {
  if (given.is_object() && p.type == ParamType::group) return drawn_config(p, given, random, decades, edges);
  std::uniform_real_distribution<double> u(0, 1);
  const auto one = [&](const Json& number, double factor) -> Json {
    double value = number.get<double>() * factor;
    const double edge = u(random);
    if (edges && p.lower && edge < 0.15)
      value = p.lower->inclusive ? p.lower->value : p.lower->value + 1e-3 * std::abs(value);
    if (edges && p.upper && edge > 0.85)
      value = p.upper->inclusive ? p.upper->value : p.upper->value - 1e-3 * std::abs(p.upper->value);
    if (p.type == ParamType::integer) value = std::round(value);
    if (p.lower && (value < p.lower->value || (!p.lower->inclusive && value == p.lower->value))) return number;
    if (p.upper && (value > p.upper->value || (!p.upper->inclusive && value == p.upper->value))) return number;
    return p.type == ParamType::integer ? Json(std::int64_t(value)) : Json(value);
  };
  if (p.type == ParamType::quantity_list && given.is_array()) {
    Json list = Json::array();
    for (const Json& item : given)
      list.push_back(item.is_number() ? one(item, std::pow(10.0, decades * (2 * u(random) - 1))) : item);
    return list;
  }
  if ((p.type == ParamType::quantity || p.type == ParamType::integer) && given.is_number())
    return one(given, std::pow(10.0, decades * (2 * u(random) - 1)));
  return given;
}

}  // namespace

bool is_given(const std::vector<std::string>& parameters, const std::string& member) {
  return std::any_of(parameters.begin(), parameters.end(), [&](const std::string& p) {
    return p.starts_with(member) && p.size() > member.size() &&
           std::string_view("=.[").find(p[member.size()]) != std::string_view::npos;
  });
}

PluginChoice example_plugin(const Registry& registry, const std::string& kind, const std::string& name,
                            const std::vector<std::string>& parameters, const Preset& preset) {
  const ParamSpec& root = registry.documentation(kind, name).root;
  const std::string section = kind + ".";
  std::vector<std::string> own, overrides;
  for (const std::string& p : parameters) own.push_back(p.starts_with(section) ? p.substr(section.size()) : p);
  for (const std::string& p : own) overrides.push_back(section + p);
  Schema<Wanted> schema;
  schema.param(kind.c_str(), &Wanted::plugin).kind(kind.c_str()).doc("what is checked");
  const Noting directory(registry);
  std::vector<std::string> more;
  for (;;) {
    directory.issues.clear();
    try {
      const Json config = read_config(Section(root, own, preset).text(kind, name, more), kind + "/" + name,
                                      schema.documentation().root, directory, overrides);
      return schema.load(config).plugin;
    } catch (const ConfigError&) {
      const std::size_t before = more.size();
      for (const Issue& issue : directory.issues)
        for (const ParamSpec& p : root.members)
          if (p.name == issue.path && p.fallback.is_null() && !example_of(p).empty() && !is_given(own, p.name) &&
              !std::count(more.begin(), more.end(), p.name))
            more.push_back(p.name);
      if (more.size() == before) throw;
    }
  }
}

Json drawn_config(const ParamSpec& root, const Json& config, std::mt19937_64& random, double decades, bool edges) {
  Json other = config;
  for (const ParamSpec& p : root.members)
    if (other.contains(p.name)) other[p.name] = drawn(p, other[p.name], random, decades, edges);
  return other;
}

}  // namespace breccia
