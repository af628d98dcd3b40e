// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "config/json_schema.hpp"
#include "study/study_schema.hpp"
#include "workflow/workflow.hpp"

namespace breccia::cli {

int schema(const std::string& of) {
  const Registry registry;
  fmt::print("{}\n", (of == "sweep" ? study_json_schema(registry) : json_schema(workflow_schema(), registry)).dump(1));
  return ok;
}

}  // namespace breccia::cli
