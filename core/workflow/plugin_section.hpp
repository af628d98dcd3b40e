// SPDX-License-Identifier: BSD-3-Clause
/// The `plugins:` section of a workflow, read before all else.
#pragma once

#include <filesystem>
#include <vector>

#include "config/base_chain.hpp"

namespace breccia {

/// Paths under `plugins:` of the workflow as its bases, the variant and the overrides leave it, absolute: what
/// resolved.yaml will record is what is loaded. Tolerant: whatever is wrong is left to the full reading, which can name
/// every problem once the plugins are known.
std::vector<std::filesystem::path> plugin_paths(const BaseChain& chain, const std::vector<std::string>& overrides = {},
                                                const std::string& variant = {});
/// The same with the values of a study.
std::vector<std::filesystem::path> plugin_paths(const BaseChain& chain, const ValuesOnTop& on_top);

}  // namespace breccia
