// SPDX-License-Identifier: BSD-3-Clause
/// Small parts of messages and names.
#pragma once

#include <string>
#include <string_view>

#include "breccia/si_unit.hpp"

namespace breccia {

/// As messages show what a user wrote or may write.
inline std::string in_ticks(std::string_view text) { return "`" + std::string(text) + "`"; }

using detail::is_digit;  // of the ten that numbers are written with, whatever the locale

}  // namespace breccia
