// SPDX-License-Identifier: BSD-3-Clause
#include "study/study_schema.hpp"

#include "config/json_schema.hpp"
#include "study/study.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

Json define_values(Json& schema, const PluginDirectory& plugins) {
  const ValuesByPath values = json_schema_by_path(workflow_schema(), plugins);
  for (const auto& [name, definition] : values.definitions.items()) schema["definitions"][name] = definition;
  Json one = Json::object();
  for (const auto& [path, value] : values.of_path.items()) {
    const std::string name = "value_" + std::to_string(one.size());
    schema["definitions"][name] = value;
    one[path] = {{"$ref", "#/definitions/" + name}};
  }
  return one;
}

Json study_json_schema(const PluginDirectory& plugins) {
  Json schema = json_schema(study_schema(), plugins, "Breccia study");
  const Json one = define_values(schema, plugins);
  Json several = Json::object();
  for (const auto& [path, value] : one.items()) several[path] = {{"type", "array"}, {"minItems", 1}, {"items", value}};
  schema["definitions"]["columns"] = {
      {"minProperties", 1}, {"patternProperties", several}, {"additionalProperties", false}};
  for (const char* const section : {"grid", "list"})
    schema["properties"][section]["allOf"] = Json::array({Json{{"$ref", "#/definitions/columns"}}});
  schema["properties"]["fixed"]["patternProperties"] = one;
  schema["properties"]["fixed"]["additionalProperties"] = false;
  return schema;
}

}  // namespace breccia
