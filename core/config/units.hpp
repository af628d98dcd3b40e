// SPDX-License-Identifier: BSD-3-Clause
/// Quantities with units, through UDUNITS-2: "10 GPa", "70 psi", "2650 kg/m3", "23 %".
///
/// Decimal prefixes only move the decimal point, so "23 mm" and "0.023 m" are the same bits. What is a pure number
/// and what is an angle are told apart ("30 deg" is not a friction coefficient), and reciprocals are not converted
/// ("10 Hz" is not a time).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "breccia/error.hpp"

namespace breccia {

/// A quantity as read: `si = number * factor + offset`.
struct Quantity {
  double si = 0;
  double factor = 1, offset = 0;
  std::string unit;  ///< as written; empty for a pure number
};

/// Reads `text` as a quantity of the dimension of `si_unit` ("Pa", "kg/m3", "rad"; "1" for a pure number).
/// UserError when it is not a finite number, has no unit, an unknown one or one of another dimension.
Quantity read_quantity(std::string_view text, const std::string& si_unit);

/// The SI value alone.
double parse_quantity(std::string_view text, const std::string& si_unit);

/// The SI unit of the dimension in which `text` is written ("Pa" for "120 MPa", "1" for a pure number or a share),
/// where nothing says which is needed. UserError when it is no number, or when its unit is unknown or measures nothing
/// that has a common name.
std::string si_unit_of(std::string_view text);

/// Shortest text that `parse_quantity` turns into the same bits: "0.023 m"; "0.5" for a pure number.
std::string format_quantity(double si, const std::string& si_unit);

/// What a unit measures, with its article: "a pressure", "a length"; "a quantity in `X`" when it has no common name.
std::string dimension_name(const std::string& si_unit);

/// What to write for it: "a pressure such as Pa, MPa, GPa or psi".
std::string needed_quantity(const std::string& si_unit);

/// Spellings that exist and are refused, since their prefix is almost surely another one's: "mPa".
std::vector<std::string> units_taken_for_slips();

/// A unit of that dimension as rock mechanics would write it: "MPa" for "Pa"; `si_unit` itself when none is listed.
std::string usual_unit(const std::string& si_unit);

}  // namespace breccia
