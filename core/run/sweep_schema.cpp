// SPDX-License-Identifier: BSD-3-Clause
#include "run/sweep_schema.hpp"

#include "config/json_schema.hpp"
#include "run/sweep_study.hpp"
#include "run/workflow.hpp"

namespace breccia {

Json study_json_schema(const PluginDirectory& plugins) {
  Json schema = json_schema(study_schema(), plugins, "Breccia study");
  const ValuesByPath values = json_schema_by_path(workflow_schema(), plugins);
  for (const auto& [name, definition] : values.definitions.items()) schema["definitions"][name] = definition;
  Json one = Json::object(), several = Json::object(), any = Json::array();
  for (const auto& [path, value] : values.of_path.items()) {
    const std::string name = "value_" + std::to_string(any.size());
    any.push_back(path);
    schema["definitions"][name] = value;
    one[path] = {{"$ref", "#/definitions/" + name}};
    several[path] = {{"type", "array"}, {"minItems", 1}, {"items", one[path]}};
  }
  for (const char* const section : {"fixed", "grid", "list"}) {
    Json& of = schema["properties"][section];
    of["patternProperties"] = std::string(section) == "fixed" ? one : several;
    of["additionalProperties"] = false;
    if (std::string(section) != "fixed") of["minProperties"] = 1;
  }
  return schema;
}

}  // namespace breccia
