// SPDX-License-Identifier: BSD-3-Clause
/// The spelling of units, checked before UDUNITS sees it: that library would take "5 m" or "m 5" for a unit.
#pragma once

#include <string>
#include <string_view>

namespace breccia {

/// Empty when `unit` is spelt as a unit may be ("kN m/rad", "kg.m-3", "m^2", "1/s"); else what is wrong with it.
std::string unit_syntax_problem(std::string_view unit);

}  // namespace breccia
