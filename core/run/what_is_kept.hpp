// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// What a run that has ended before its time leaves, and how it goes on; empty when it leaves nothing. `place`: where
/// its files are; `folder`: that of its results, as the user named it.
std::string what_is_kept(const std::filesystem::path& place, const std::filesystem::path& folder);

}  // namespace breccia
