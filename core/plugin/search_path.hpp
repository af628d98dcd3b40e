// SPDX-License-Identifier: BSD-3-Clause
/// Where plugins are looked for when the workflow names no files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

struct PluginFolder {
  std::filesystem::path path;
  std::string named_by;  ///< who asked for it: its absence is worth a warning; empty for a conventional place
};

/// Where the program file itself lies, wherever the link to it stands through which it was started; empty when that
/// cannot be known.
std::filesystem::path program_folder();

/// The folders of BRECCIA_PLUGIN_PATH (separated by colons), then `../lib/breccia` and `plugins` beside the program.
std::vector<PluginFolder> default_plugin_folders();

}  // namespace breccia
