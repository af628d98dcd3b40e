// SPDX-License-Identifier: BSD-3-Clause
/// Units as regular expressions, for the JSON Schema: an editor has no UDUNITS.
#pragma once

#include <string>

namespace breccia {

/// ECMAScript, without anchors: what may follow a number for a quantity whose SI unit is `si_unit`. Built from the
/// usual words of units, whose dimensions UDUNITS tells: one of them with its power, products and quotients of two or
/// three. What it cannot judge (parentheses, long names such as `pascals`, more than three factors) it admits.
std::string unit_pattern(const std::string& si_unit);

}  // namespace breccia
