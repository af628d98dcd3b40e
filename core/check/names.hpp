// SPDX-License-Identifier: BSD-3-Clause
/// What names and units of results must look like.
#pragma once

#include <cctype>
#include <string>

#include "breccia/si_unit.hpp"

namespace breccia {

/// Empty when it may be the name of a curve, field, table or a column of one, in this unit.
inline std::string fault_of_name(const std::string& name, const std::string& unit) {
  if (name.empty()) return "it has no name";
  for (const char c : name)
    if (!std::islower(static_cast<unsigned char>(c)) && !std::isdigit(static_cast<unsigned char>(c)) && c != '_')
      return "names are in lower case, with underscores";
  if (unit.empty()) return "it has no unit; that of a pure number is \"1\"";
  if (!detail::is_si(unit)) return "the unit `" + unit + "` is not SI";
  return {};
}

}  // namespace breccia
