// SPDX-License-Identifier: BSD-3-Clause
/// SHA-256 of file contents, for the record of what a result was made with. Its own sixty lines rather than a
/// dependency on a cryptographic library: nothing here is a secret, and the standard tool `sha256sum` checks it.
/// Source: NIST FIPS 180-4, sections 4.1.2, 4.2.2, 5.1.1, 5.3.3 and 6.2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace breccia {

/// Of bytes that come piece by piece; may be copied byte by byte, and gone on with elsewhere.
class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  std::string hex() const;  ///< of all so far: 64 lower-case hexadecimal digits

 private:
  // The first 32 bits of the fractional parts of the square roots of the first eight primes.
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::uint64_t size_ = 0;  ///< bytes so far; those behind the last whole block of 64 are in `rest_`
  std::array<std::byte, 64> rest_{};
};

/// 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
inline std::string sha256(std::string_view text) { return sha256(std::as_bytes(std::span(text))); }

}  // namespace breccia
