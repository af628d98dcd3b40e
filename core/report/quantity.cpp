// SPDX-License-Identifier: BSD-3-Clause
#include "report/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "breccia/shown_unit.hpp"

namespace breccia::report {
namespace {

/// "3e10 Pa": number and unit; NaN when the text does not begin with a number that a space or nothing follows.
std::pair<double, std::string> taken_apart(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || (rest != end && *rest != ' ')) return {std::numeric_limits<double>::quiet_NaN(), ""};
  return {value, rest == end ? "" : std::string(rest + 1, end)};
}

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

std::string distribution_text(const Json& written) {
  std::string out = written.value("distribution", "") + " distribution";
  for (const auto& [key, value] : written.items()) {
    if (key == "distribution") continue;
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', ' ');
    out += ", " + name + " " + value_text(value);
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
    text = text.substr(0, e) + "\u00A0×\u00A010" + raised(power);
  }
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

std::string percent_text(double share, int digits) { return number_text(100 * share, digits) + "\u00A0%"; }

Quantity quantity(double si, const std::string& unit, double like) {
  if (unit == "rad") return {number_text(si * 180 / std::numbers::pi), "°"};
  const double size = std::abs(like != 0 ? like : si);
  ShownUnit shown = shown_unit(unit, size);
  if (unit == "m/s" && size >= 0.01) shown = {1, unit};
  if (unit == "m" && size >= 1e-4 && size < 1) shown = {1e3, "mm"};  // of grains and specimens
  return {number_text(si * shown.factor), readable_unit(shown.unit)};
}

double number_of(const Json& written) {
  if (written.is_number()) return written.get<double>();
  return written.is_string() ? taken_apart(written.get<std::string>()).first : std::numeric_limits<double>::quiet_NaN();
}

bool is_quantity(const Json& written) { return !std::isnan(number_of(written)); }

std::string value_text(const Json& written) {
  if (written.is_boolean()) return written.get<bool>() ? "yes" : "no";
  if (written.is_number()) return number_text(written.get<double>(), 6);
  if (written.is_string()) {
    std::string text = written.get<std::string>();
    if (const auto [value, unit] = taken_apart(text); !std::isnan(value)) return quantity(value, unit).text();
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
  }
  if (written.is_array()) {
    std::string out;
    for (const Json& item : written) {
      const std::string text = value_text(item);
      if (text.empty()) return {};
      out += (out.empty() ? "" : ", ") + text;
    }
    return out;
  }
  return written.is_object() && written.contains("distribution") && written["distribution"].is_string()
             ? distribution_text(written)
             : std::string();
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text;
}

}  // namespace breccia::report
