// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "calibrate/calibration_schema.hpp"
#include "cli/verbs.hpp"
#include "config/json_schema.hpp"
#include "plugin/registry.hpp"
#include "study/study_schema.hpp"
#include "workflow/workflow.hpp"

namespace breccia::cli {

int schema(const std::string& of) {
  const Registry registry;
  const Json schema = of == "sweep"         ? study_json_schema(registry)
                      : of == "calibration" ? calibration_json_schema(registry)
                                            : json_schema(workflow_schema(), registry);
  fmt::print("{}\n", schema.dump(1));
  return ok;
}

}  // namespace breccia::cli
