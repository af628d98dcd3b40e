// SPDX-License-Identifier: BSD-3-Clause
/// What made a result besides its input: versions and contents of the program, the plugins, the packing, the files
/// read.
#pragma once

#include "workflow/read_workflow.hpp"

namespace breccia {

/// For the section `provenance` of resolved.yaml. `packing`: hash of the packing's particles.
Json provenance_of(const Workflow& workflow, const Registry& registry, const std::string& packing);

/// What is another now than when the workflow was resolved, a sentence each; nothing for one that never was.
std::vector<std::string> changes_since(const Json& then, const Json& now);

}  // namespace breccia
