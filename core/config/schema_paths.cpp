// SPDX-License-Identifier: BSD-3-Clause
/// Values by their paths (`contact_law.friction`), as studies have them.
#include <map>
#include <set>

#include "config/json_schema.hpp"
#include "config/schema_writer.hpp"

namespace breccia {

namespace {

constexpr const char *item = "(?:\\[[0-9]+\\]|\\.[0-9]+)", *any_name = "\\.[^.\\[]+";

class PathSchema {
 public:
  explicit PathSchema(const PluginDirectory& plugins) : plugins_(plugins), writer_(plugins) {}

  ValuesByPath of(const ParamSpec& root) {
    for (const ParamSpec& member : root.members) {
      if (member.name == "base") continue;
      if (member.name == "variants") {  // `variant` does as well: a name, or one of the study's own
        add("variants?", {{"type", Json::array({"string", "object"})}});
        continue;
      }
      add_value(member, member.name);
    }
    ValuesByPath all;
    for (const auto& [path, schemas] : found_) {
      Json any = Json::array();
      for (const std::string& schema : schemas) any.push_back(Json::parse(schema));
      all.of_path["^" + path + "$"] = any.size() == 1 ? any[0] : Json{{"anyOf", any}};
    }
    all.definitions = writer_.definitions().all();
    return all;
  }

 private:
  /// Several plugins may have a parameter of that name.
  void add(const std::string& path, const Json& schema) { found_[path].insert(schema.dump()); }

  void add_members(const ParamSpec& group, const std::string& path) {
    for (const ParamSpec& member : group.members) add_value(member, path + "\\." + member.name);
  }

  void add_plugins(const ParamSpec& spec, const std::string& path, bool listed) {
    Json names = Json::array();
    for (const std::string& name : plugins_.names(spec.plugin_kind)) {
      names.push_back(name);
      try {
        const ParamSpec& own = plugins_.documentation(spec.plugin_kind, name).root;
        add_members(listed ? as_listed(own) : own, path);
      } catch (const UserError&) {
        add(path + ".+", true);  // it does not load on this machine
      }
    }
    add(path + "\\.type", {{"enum", names}});
  }

  /// Sections as a whole are rare in studies, and would make the schema as large as that of workflows.
  void add_section(const std::string& path, const char* type) { add(path, {{"type", type}}); }

  void add_value(const ParamSpec& spec, const std::string& path) {
    ParamSpec one = spec;
    switch (spec.type) {
      case ParamType::plugin:
        add_section(path, "object");
        return add_plugins(spec, path, false);
      case ParamType::plugin_list:
        add_section(path, "array");
        add_section(path + item, "object");
        return add_plugins(spec, path + item, true);
      case ParamType::plugin_stack:
        add(path, {{"type", Json::array({"array", "object"})}});
        add_section(path + item, "object");
        return add_plugins(spec, path + item + "?", true);
      case ParamType::group_list:
        add_section(path, "array");
        one.type = ParamType::group;
        return add_value(one, path + item);
      case ParamType::group:
        add_section(path, "object");
        return add_members(spec, path);
      case ParamType::group_map:
        add_section(path, "object");
        return add_members(spec, path + any_name);
      case ParamType::quantity_map:
        add_section(path, "object");
        one.type = ParamType::quantity;
        return add(path + any_name, writer_.bare_value(one));
      case ParamType::quantity_list:
      case ParamType::text_list:
        add(path, writer_.bare_value(spec));
        one.type = spec.type == ParamType::text_list ? ParamType::text : ParamType::quantity;
        return add(path + item, writer_.bare_value(one));
      case ParamType::quantity:
        one.per_bond = false;
        add(path, writer_.bare_value(one));
        if (!spec.per_bond) return;
        add_section(path, "object");
        return add_members(distribution_spec(spec), path);
      case ParamType::free_form:
        return add(path + "(?:[.\\[].+)?", true);
      default:
        return add(path, writer_.bare_value(spec));
    }
  }

  const PluginDirectory& plugins_;
  SchemaWriter writer_;
  std::map<std::string, std::set<std::string>> found_;
};

}  // namespace

ValuesByPath json_schema_by_path(const ParamSpec& root, const PluginDirectory& plugins) {
  return PathSchema(plugins).of(root);
}

}  // namespace breccia
