// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "calibrate/calibration.hpp"
#include "cli/verbs.hpp"
#include "config/json_schema.hpp"
#include "study/study.hpp"
#include "workflow/workflow.hpp"

namespace breccia::cli {

int schema(const std::string& of) {
  const Registry registry;
  const Json schema = of == "sweep"         ? json_schema(study_schema(), registry, "Breccia study")
                      : of == "calibration" ? json_schema(calibration_schema(), registry, "Breccia calibration")
                                            : json_schema(workflow_schema(), registry);
  fmt::print("{}\n", schema.dump(2));
  return ok;
}

}  // namespace breccia::cli
