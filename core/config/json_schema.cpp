// SPDX-License-Identifier: BSD-3-Clause
#include "config/json_schema.hpp"

#include "config/schema_writer.hpp"

namespace breccia {

Json json_schema(const ParamSpec& root, const PluginDirectory& plugins, const std::string& title) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(SchemaWriter(plugins).root(root));
  return schema;
}

}  // namespace breccia
