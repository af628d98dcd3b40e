// SPDX-License-Identifier: BSD-3-Clause
/// SHA-256 of file contents, for the record of what a result was made with. Its own sixty lines rather than a
/// dependency on a cryptographic library: nothing here is a secret, and the standard tool `sha256sum` checks it.
/// Source: NIST FIPS 180-4, sections 4.1.2, 4.2.2, 5.1.1, 5.3.3 and 6.2.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace breccia {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
inline std::string sha256(std::string_view text) { return sha256(std::as_bytes(std::span(text))); }

}  // namespace breccia
