// SPDX-License-Identifier: BSD-3-Clause
/// What names, units and numbers of results must look like.
#pragma once

#include <cctype>
#include <string>

#include "breccia/si_unit.hpp"
#include "check/kept.hpp"

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

/// Empty when all units of a summary are SI.
inline std::string fault_of_units(const KeptSummary& summary) {
  for (const ResultName& name : summary.names)
    if (!name.unit.empty() && !detail::is_si(name.unit))
      return "result `" + name.name + "`: the unit `" + name.unit + "` is not SI";
  return {};
}

/// Empty when all that is given as a number is one.
inline std::string fault_of_numbers(const KeptSummary& summary) {
  for (const auto& [key, value] : summary.all) {
    const Json flat = value.is_structured() ? value.flatten() : Json{{"", value}};
    for (const Json& item : flat)
      if (item.is_number_float() && !std::isfinite(item.get<double>())) return "result `" + key + "` is not a number";
  }
  return {};
}

inline std::string fault_of_results(const KeptSummary& summary) {
  const std::string unit = fault_of_units(summary);
  return unit.empty() ? fault_of_numbers(summary) : unit;
}

}  // namespace breccia
