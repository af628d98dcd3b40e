// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/calibration_schema.hpp"

#include "calibrate/calibration.hpp"
#include "config/json_schema.hpp"
#include "study/study_schema.hpp"

namespace breccia {

namespace {

/// The members of a section, of each item of a list or of each section by a name.
Json& members(Json& section) {
  Json& item = section.contains("items") ? section["items"] : section;
  Json& whole = item.contains("allOf") ? item["allOf"][0] : item;
  Json& named = whole.contains("additionalProperties") && whole["additionalProperties"].is_object()
                    ? whole["additionalProperties"]
                    : whole;
  BRECCIA_ASSERT(named.contains("properties"));
  return named["properties"];
}

void must_be(Json& value, const char* definition) {
  value["allOf"].push_back({{"$ref", std::string("#/definitions/") + definition}});
}

}  // namespace

Json calibration_json_schema(const PluginDirectory& plugins) {
  Json schema = json_schema(calibration_schema(), plugins, "Breccia calibration");
  const Json values = define_values(schema, plugins);
  std::string paths;
  for (const auto& [path, value] : values.items()) paths += (paths.empty() ? "" : "|") + path;
  schema["definitions"]["path"] = {{"pattern", paths}};
  schema["definitions"]["values"] = {{"patternProperties", values}, {"additionalProperties", false}};
  Json& all = schema["properties"];
  must_be(members(all["workflows"])["set"], "values");
  must_be(members(members(all["budget"])["stages"])["set"], "values");
  Json& parameter = members(all["parameters"]);
  must_be(parameter["path"], "path");
  must_be(parameter["paths"]["items"], "path");
  return schema;
}

}  // namespace breccia
