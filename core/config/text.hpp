// SPDX-License-Identifier: BSD-3-Clause
/// Small parts of messages and names.
#pragma once

#include <string>
#include <string_view>

namespace breccia {

/// As messages show what a user wrote or may write.
inline std::string in_ticks(std::string_view text) { return "`" + std::string(text) + "`"; }

/// Of the ten that numbers are written with, whatever the locale.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace breccia
