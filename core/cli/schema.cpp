// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "config/json_schema.hpp"
#include "study/study.hpp"
#include "workflow/workflow.hpp"

namespace breccia::cli {

int schema(const std::string& of) {
  const Registry registry;
  fmt::print("{}\n", (of == "sweep" ? json_schema(study_schema(), registry, "Breccia study")
                                    : json_schema(workflow_schema(), registry))
                         .dump(2));
  return ok;
}

}  // namespace breccia::cli
