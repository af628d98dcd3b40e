// SPDX-License-Identifier: BSD-3-Clause
/// Reading of workflows, as far as no plugin has to be made for it; `run/load_workflow.hpp` goes the rest of the way.
#pragma once

#include "config/base_chain.hpp"
#include "config/places.hpp"
#include "plugin/registry.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

/// A workflow that is in order, with the configuration it came from (all defaults filled in).
struct LoadedWorkflow {
  Workflow workflow;
  Json config;
  Places places = {};                      ///< of the values in their files
  std::vector<std::string> warnings = {};  ///< of values that are most likely slips, with their places
};

/// Reads and checks a workflow file and its bases; the plugins named under `plugins:` are added to the registry first.
/// ConfigError with every problem.
LoadedWorkflow read_workflow(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                             Registry& registry, const std::string& variant = {});

/// The same of a chain whose plugins have been added, with the values of a study in it.
LoadedWorkflow read_workflow(const BaseChain& chain, const ValuesOnTop& on_top, const Registry& registry);

/// The text of a resolved.yaml that stands in the file of that name; its plugins are known already.
LoadedWorkflow read_resolved(const std::string& text, const std::filesystem::path& file, const Registry& registry);

/// Whether the first file is a study for `breccia sweep`, by its keys.
bool is_study(const BaseChain& chain);
/// The same of a calibration for `breccia calibrate`.
bool is_calibration(const BaseChain& chain);

/// Names of the variants of a workflow file and its bases.
std::vector<std::string> workflow_variants(const std::filesystem::path& file);

}  // namespace breccia
