// SPDX-License-Identifier: BSD-3-Clause
/// The encoding of workflow texts. Internal to the configuration.
#pragma once

#include <cstddef>
#include <string_view>

namespace breccia {

/// Length in bytes of the valid UTF-8 character at the start of `s`, 0 when there is none (RFC 3629).
std::size_t utf8_length(std::string_view s);

/// True for the second and later bytes of a character.
constexpr bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace breccia
