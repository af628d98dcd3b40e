// SPDX-License-Identifier: BSD-3-Clause
#include "config/result_name.hpp"

#include <algorithm>

namespace breccia {

std::string why_not_a_file_name(const std::string& name) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
  if (name.find_first_not_of(" \t\r\n") == name.npos) return "is empty";
  if (std::any_of(name.begin(), name.end(), is_control)) return "has a control character in it";
  if (name.find_first_of("/\\") != name.npos) return "has a slash in it: it is one name, not a path";
  if (name[0] == '.') return "begins with a dot";
  if (name.size() >= 200) return "is longer than 200 characters";
  return {};
}

}  // namespace breccia
