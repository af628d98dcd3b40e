// SPDX-License-Identifier: BSD-3-Clause
/// The encoding of all texts. Names of files come from the system and may be anything: `valid_utf8` and `printable`
/// make of them what may stand in a file or a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "breccia/schema.hpp"

namespace breccia {

/// True for the second and later bytes of a character.
constexpr bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length in bytes of the valid UTF-8 character at the start of `s`, 0 when there is none (RFC 3629).
inline std::size_t utf8_length(std::string_view s) {
  if (s.empty()) return 0;
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(s[k]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t n = (byte(0) & 0xE0) == 0xC0 ? 2 : (byte(0) & 0xF0) == 0xE0 ? 3 : (byte(0) & 0xF8) == 0xF0 ? 4 : 0;
  if (n == 0 || s.size() < n) return 0;
  std::uint32_t code = byte(0) & (0x7F >> n);
  for (std::size_t k = 1; k < n; ++k) {
    if (!continues_character(s[k])) return 0;
    code = code << 6 | (byte(k) & 0x3F);
  }
  const std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[n] || code > 0x10FFFF || surrogate ? 0 : n;
}

/// The text with U+FFFD for every byte that belongs to no character.
inline std::string valid_utf8(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = utf8_length(text.substr(at));
    if (n == 0) out += "\xEF\xBF\xBD";
    else out += text.substr(at, n);
    at += n == 0 ? 1 : n;
  }
  return out;
}

/// For a terminal or a log: bytes that belong to no character, and control characters other than line ends and tabs,
/// as `\xNN`.
inline std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = utf8_length(text.substr(at));
    const unsigned char c = static_cast<unsigned char>(text[at]);
    if (n == 0 || (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F) {
      constexpr const char* digits = "0123456789ABCDEF";
      out.append("\\x").append(1, digits[c >> 4]).append(1, digits[c & 15]);
    } else {
      out += text.substr(at, n);
    }
    at += n == 0 ? 1 : n;
  }
  return out;
}

/// Whether all texts of it are UTF-8: names of files need not be.
inline bool is_utf8(const Json& json) {
  if (json.is_string()) return valid_utf8(json.get_ref<const std::string&>()) == json.get_ref<const std::string&>();
  for (const Json& member : json)
    if (member.is_structured() || member.is_string())
      if (!is_utf8(member)) return false;
  return true;
}

/// JSON as it is written to files; what is no UTF-8 in it (of a file's name) becomes U+FFFD.
inline std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace breccia
