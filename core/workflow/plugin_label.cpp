// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/plugin_label.hpp"

namespace breccia {

std::string given_name(const PluginChoice& choice) {
  const auto name = choice.config.find("name");
  return name != choice.config.end() && name->is_string() ? name->get<std::string>() : std::string();
}

std::string result_label(const PluginChoice& choice) {
  const std::string name = given_name(choice);
  return name.empty() ? choice.type : name + "_" + choice.type;
}

}  // namespace breccia
