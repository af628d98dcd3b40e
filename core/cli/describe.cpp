// SPDX-License-Identifier: BSD-3-Clause
#include "config/describe.hpp"

#include <fmt/format.h>

#include "breccia/error.hpp"
#include "cli/verbs.hpp"
#include "run/sweep_study.hpp"
#include "run/workflow.hpp"

namespace breccia::cli {

int describe(const std::string& plugin, const std::string& format) {
  Registry registry;
  std::string kind = "", name = plugin;
  Documentation doc;
  if (plugin == "workflow") {
    Schema<Workflow> schema;
    Workflow::describe(schema);
    doc = schema.documentation();
  } else if (plugin == "sweep") {
    Schema<Study> schema;
    Study::describe(schema);
    doc = schema.documentation();
  } else {
    const auto slash = plugin.find('/');
    if (slash == std::string::npos)
      throw UserError("describe needs KIND/NAME (see `breccia list`) or `workflow` or `sweep`, not `" + plugin + "`");
    kind = plugin.substr(0, slash);
    name = plugin.substr(slash + 1);
    doc = registry.documentation(kind, name);
  }
  if (format == "json") fmt::print("{}\n", describe_json(kind, name, doc).dump(2));
  else fmt::print("{}", format == "markdown" ? describe_markdown(kind, name, doc) : describe_text(kind, name, doc));
  return ok;
}

}  // namespace breccia::cli
