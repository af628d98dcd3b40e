// SPDX-License-Identifier: BSD-3-Clause
/// What a whole has and a part may lack, for the JSON Schema: only which keys must be there, section by section.
#pragma once

#include <string>

#include "config/plugin_directory.hpp"
#include "config/quantity_schema.hpp"

namespace breccia {

class SchemaNeeds {
 public:
  SchemaNeeds(const PluginDirectory& plugins, SchemaDefinitions& definitions)
      : plugins_(plugins), definitions_(definitions) {}

  /// Of a group or an item of a list of groups; an empty object when nothing is needed.
  Json of(const ParamSpec& group);
  /// Of a section of any plugin of the kind.
  Json of_plugin(const ParamSpec& section);
  static Json has_type(const std::string& name);

 private:
  Json of_member(const ParamSpec& member);
  const PluginDirectory& plugins_;
  SchemaDefinitions& definitions_;
};

}  // namespace breccia
