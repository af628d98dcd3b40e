// SPDX-License-Identifier: BSD-3-Clause
/// Random numbers that depend on what they are for, not on the order in which they are drawn.
/// Source: Salmon, Moraes, Dror, Shaw (2011), Parallel random numbers: as easy as 1, 2, 3, SC11 (Philox 4x32-10).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace breccia {

using Counter = std::array<std::uint32_t, 4>;

/// Philox 4x32 with ten rounds.
constexpr Counter philox(Counter c, std::uint32_t key0, std::uint32_t key1) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * c[0], b = 0xCD9E8D57ull * c[2];
    c = {std::uint32_t(b >> 32) ^ c[1] ^ key0, std::uint32_t(b), std::uint32_t(a >> 32) ^ c[3] ^ key1,
         std::uint32_t(a)};
    key0 += 0x9E3779B9u;
    key1 += 0xBB67AE85u;
  }
  return c;
}

/// Evenly between 0 and 1, never either of them, for one use (`stream`) and two numbers that say what it is for.
constexpr double uniform(std::uint64_t seed, std::uint64_t stream, std::uint32_t a, std::uint32_t b) {
  const Counter c = philox({a, b, std::uint32_t(stream), std::uint32_t(stream >> 32)}, std::uint32_t(seed),
                           std::uint32_t(seed >> 32));
  const std::uint64_t bits = (std::uint64_t(c[0]) << 32 | c[1]) >> 11;
  return (double(bits) + 0.5) * 0x1p-53;
}

/// The stream of a use by its name (FNV-1a).
constexpr std::uint64_t stream_of(std::string_view use) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const char ch : use) h = (h ^ std::uint8_t(ch)) * 0x100000001b3ull;
  return h;
}

}  // namespace breccia
