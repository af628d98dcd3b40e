// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cli/verbs.hpp"
#include "config/json_schema.hpp"
#include "run/workflow.hpp"

namespace breccia::cli {

int schema() {
  const Registry registry;
  fmt::print("{}\n", json_schema(workflow_schema(), registry).dump(2));
  return ok;
}

}  // namespace breccia::cli
