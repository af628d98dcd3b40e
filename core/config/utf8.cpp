// SPDX-License-Identifier: BSD-3-Clause
#include "config/utf8.hpp"

#include <cstdint>

namespace breccia {

std::size_t utf8_length(std::string_view s) {
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

}  // namespace breccia
