// SPDX-License-Identifier: BSD-3-Clause
/// The `plugins:` section of a workflow, read before all else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

/// Paths under `plugins:`, relative ones from the workflow's folder. Tolerant: whatever is wrong in the text is left to
/// the full reading, which can name every problem once the plugins are known.
std::vector<std::filesystem::path> plugin_paths(const std::string& yaml_text, const std::filesystem::path& file);

}  // namespace breccia
