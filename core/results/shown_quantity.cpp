// SPDX-License-Identifier: BSD-3-Clause
#include "results/shown_quantity.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "breccia/shown_unit.hpp"

namespace breccia {
namespace {

std::string raised(int power) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = power < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(power))) out += digits[c - '0'];
  return out;
}

/// "kg/m3" as "kg/m³".
std::string readable_unit(const std::string& unit) {
  std::string out;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const bool power =
        k > 0 && std::isalpha(static_cast<unsigned char>(unit[k - 1])) && (unit[k] == '2' || unit[k] == '3');
    out += power ? (unit[k] == '2' ? "²" : "³") : std::string(1, unit[k]);
  }
  return out;
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "–" : value < 0 ? "−∞" : "∞";
  const bool is_count = value == std::round(value) && std::abs(value) < 1e7;
  std::string text = is_count ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.{}g}", value, digits);
  if (const std::size_t e = text.find('e'); e != text.npos) {
    const int power = std::stoi(text.substr(e + 1));
    const bool is_short = power > 0 && power < 4;  // 1.38e3, to three digits: 1380
    if (is_short) text = fmt::format("{:.0f}", std::stod(text));
    else text = text.substr(0, e) + "\u00A0×\u00A010" + raised(power);
  }
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

ShownQuantity shown_quantity(double si, const std::string& unit, double like, int digits) {
  if (unit == "rad") return {number_text(si * 180 / std::numbers::pi, digits), "°"};
  const double size = std::abs(like != 0 ? like : si);
  ShownUnit shown = shown_unit(unit, size);
  if (unit == "m/s" && size >= 0.01) shown = {1, unit};
  if (unit == "m" && size >= 1e-4 && size < 1) shown = {1e3, "mm"};  // of grains and specimens
  return {number_text(si * shown.factor, digits), readable_unit(shown.unit)};
}

ShownQuantity shown_quantity(double si, const std::string& unit, const ChosenUnit& chosen, double like, int digits) {
  const double size = std::abs(like) / chosen.factor;
  if (chosen.name.empty() || (size > 0 && (size < 1e-2 || size >= 1e4))) return shown_quantity(si, unit, like, digits);
  return {number_text(si / chosen.factor, digits), chosen.name == "deg" ? "°" : readable_unit(chosen.name)};
}

}  // namespace breccia
