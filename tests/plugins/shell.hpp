// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace breccia::testing {

struct Output {
  int code;  ///< as `system` has it: 0 when it went well
  std::string text;
};

/// What a command leaves on either stream.
inline Output shell(const std::string& command) {
  Output out{-1, ""};
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> part;
  while (std::fgets(part.data(), part.size(), pipe)) out.text += part.data();
  out.code = pclose(pipe);
  return out;
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace breccia::testing
