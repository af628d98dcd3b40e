// SPDX-License-Identifier: BSD-3-Clause
/// Numbers and units as people read them: 2.372e8 in Pa is 237.2 MPa.
#pragma once

#include <string>

#include "breccia/schema.hpp"

namespace breccia::report {

struct Quantity {
  std::string number, unit;  ///< "237.2", "MPa"; no unit for a pure number
  std::string text() const {
    return unit.empty() ? number : number + (unit == "°" || unit == "%" ? "" : "\u00A0") + unit;
  }
};

/// Four digits, an SI prefix where the unit takes one, degrees for radians, "m³" for m3. `like`: with the prefix that
/// this number has, so that the two can be compared at a glance.
Quantity quantity(double si, const std::string& unit, double like = 0);
std::string number_text(double value, int digits = 4);  ///< "1.372 × 10⁻⁷"
std::string percent_text(double share, int digits = 3);

/// A value as resolved.yaml has it: "3e10 Pa" is 30 GPa; a name loses its underscores. A mapping with `distribution`
/// is told in words; other structures are empty.
std::string value_text(const Json& written);
bool is_quantity(const Json& written);  ///< a number, with a unit or without
/// The number of "3e10 Pa", in the unit that it has; NaN when it is none.
double number_of(const Json& written);

/// With a capital at its beginning.
std::string capital(std::string text);

}  // namespace breccia::report
