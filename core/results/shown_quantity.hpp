// SPDX-License-Identifier: BSD-3-Clause
/// Numbers with units as people read them: 2.372e8 in Pa is 237.2 MPa. For reports, tables, messages.
#pragma once

#include <string>

namespace breccia {

struct ShownQuantity {
  std::string number, unit;  ///< "237.2", "MPa"; no unit for a pure number
  /// Kept on one line; `text(" ")` for terminals.
  std::string text(const char* between = "\u00A0") const {
    return unit.empty() ? number : number + (unit == "°" || unit == "%" ? "" : between) + unit;
  }
};

/// Four digits, an SI prefix where the unit takes one, degrees for radians, "m³" for m3. `like`: with the prefix that
/// this number has, so that the two can be compared at a glance.
ShownQuantity shown_quantity(double si, const std::string& unit, double like = 0, int digits = 4);

/// A unit that somebody has chosen, with how much of the SI unit it is; none where `name` is empty.
struct ChosenUnit {
  std::string name;
  double factor = 1;
};

/// In the chosen unit, unless numbers such as `like` have many digits or zeros there (7e10 Pa): then as above.
ShownQuantity shown_quantity(double si, const std::string& unit, const ChosenUnit& chosen, double like, int digits = 4);

std::string number_text(double value, int digits = 4);  ///< "1.372 × 10⁻⁷"

}  // namespace breccia
