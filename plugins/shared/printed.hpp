// SPDX-License-Identifier: BSD-3-Clause
/// Numbers in messages.
#pragma once

#include <cstdio>
#include <string>

namespace breccia {

/// As std::printf writes it; at most 499 characters.
template <class... A>
std::string printed(const char* format, A... a) {
  char buffer[500];
  std::snprintf(buffer, sizeof buffer, format, a...);
  return buffer;
}

}  // namespace breccia
