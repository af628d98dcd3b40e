// SPDX-License-Identifier: BSD-3-Clause
/// What to write instead of a name that is not there.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace breccia::pictures {

/// "a, b, c, d and 20 more": a warning is read when it is short.
std::string first_of(const std::vector<std::string>& names);

/// Which of them differs from `name` by a slip of the pen; none when all are far from it.
std::optional<std::size_t> nearest_of(const std::string& name, const std::vector<std::string>& names);

}  // namespace breccia::pictures
