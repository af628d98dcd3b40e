// SPDX-License-Identifier: BSD-3-Clause
/// The `plugins:` section of a workflow, read before all else.
#pragma once

#include <filesystem>
#include <vector>

#include "config/base_chain.hpp"

namespace breccia {

/// Paths under `plugins:` of the workflow, or of the first of its bases that has that section; relative ones from the
/// folder of that file. Tolerant: whatever is wrong is left to the full reading, which can name every problem once the
/// plugins are known.
std::vector<std::filesystem::path> plugin_paths(const BaseChain& chain);

}  // namespace breccia
