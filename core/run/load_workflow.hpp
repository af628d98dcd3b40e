// SPDX-License-Identifier: BSD-3-Clause
/// A workflow that can be run: read, and each of its plugins made once.
#pragma once

#include "workflow/read_workflow.hpp"

namespace breccia {

/// As `read_workflow`; makes each of its plugins once, looks for the files that its packing needs and for the
/// checkpoint that it begins from. ConfigError with every problem.
LoadedWorkflow load_workflow(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                             Registry& registry, const std::string& variant = {});
LoadedWorkflow load_workflow(const BaseChain& chain, const ValuesOnTop& on_top, const Registry& registry);
LoadedWorkflow load_resolved(const std::string& text, const std::filesystem::path& file, const Registry& registry);

}  // namespace breccia
