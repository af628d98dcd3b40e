// SPDX-License-Identifier: BSD-3-Clause
/// What a plugin has left in a folder.
#pragma once

#include <map>

#include "breccia/text_file.hpp"

namespace breccia {

using Files = std::map<std::string, std::string>;  // bytes by name, relative to the folder

/// None of a folder that is not there.
inline Files files_in(const std::filesystem::path& folder) {
  Files all;
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
    if (entry.is_regular_file()) all[entry.path().lexically_relative(folder).string()] = read_bytes(entry.path());
  return all;
}

}  // namespace breccia
