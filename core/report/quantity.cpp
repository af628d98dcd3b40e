// SPDX-License-Identifier: BSD-3-Clause
#include "report/quantity.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

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

std::string percent_text(double share, int digits) { return number_text(100 * share, digits) + "\u00A0%"; }

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
    if (const auto [value, unit] = taken_apart(text); !std::isnan(value)) return shown_quantity(value, unit).text();
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
