// SPDX-License-Identifier: BSD-3-Clause
/// Quantities as people read them: 2.4e8 Pa is 240 MPa. For tables, charts, texts.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

namespace breccia {

struct ShownUnit {
  double factor = 1;  ///< shown number over the number in SI
  std::string unit;   ///< "MPa"; empty for a pure number
};

/// With the SI prefix that suits `largest`, which is in the SI unit `unit`: the numbers are then between 1 and 1000.
/// Units that take none, and values that are zero or no finite number, stay as they are. Areas and volumes are those of
/// a square, a cube of such a length.
inline ShownUnit shown_unit(const std::string& unit, double largest) {
  if (unit.empty() || unit == "1") return {};
  if (!(largest > 0) || !std::isfinite(largest)) return {1, unit};
  if (unit == "m2" || unit == "m3") {
    const bool square = unit == "m2";
    const ShownUnit side = shown_unit("m", square ? std::sqrt(largest) : std::cbrt(largest));
    return {std::pow(side.factor, square ? 2 : 3), side.unit + (square ? "²" : "³")};
  }
  // Those whose first symbol may have a prefix that scales the whole: no powers.
  constexpr std::string_view all[] = {"Pa",   "m",   "s",   "N",    "J",    "W",    "N/m",
                                      "Pa/m", "m/s", "N m", "Pa s", "J/m2", "N s/m"};
  if (std::find(std::begin(all), std::end(all), unit) == std::end(all)) return {1, unit};
  constexpr const char* prefixes[] = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  int power = std::clamp(int(std::floor(std::log10(largest) / 3 + 1e-9)), -4, 4);
  if (unit[0] == 'm' || unit[0] == 's') power = std::min(power, 0);  // nobody says 3 ks
  return {std::pow(10.0, -3 * power), prefixes[power + 4] + unit};
}

}  // namespace breccia
