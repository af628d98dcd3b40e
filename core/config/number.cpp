// SPDX-License-Identifier: BSD-3-Clause
#include "config/number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "breccia/error.hpp"
#include "config/text.hpp"

namespace breccia {

std::optional<DecimalText> scan_decimal(std::string_view text) {
  std::size_t at = 0;
  const auto digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    return at - from;
  };
  DecimalText number;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
    if (text[at] == '-') number.mantissa = "-";
    ++at;
  }
  const std::size_t first = at;
  std::size_t count = digits();
  if (at < text.size() && text[at] == '.') {
    ++at;
    count += digits();
  }
  if (count == 0) return {};
  number.mantissa += text.substr(first, at - first);
  number.length = at;
  // An `e` without digits belongs to what follows ("10 eV", "5eV").
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    const bool negative = at < text.size() && text[at] == '-';
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t from = at;
    if (digits() > 0) {
      for (std::size_t k = from; k < at; ++k)
        number.exponent = std::min(number.exponent * 10 + (text[k] - '0'), 1000000L);
      if (negative) number.exponent = -number.exponent;
      number.length = at;
    }
  }
  return number;
}

bool has_leading_zero(const DecimalText& number) {
  const std::size_t first = number.mantissa[0] == '-' ? 1 : 0;
  return number.mantissa.size() > first + 1 && number.mantissa[first] == '0' && is_digit(number.mantissa[first + 1]);
}

std::optional<double> to_double(const DecimalText& number, int shift) {
  const std::string text = number.mantissa + "e" + std::to_string(number.exponent + shift);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  // A zero stays a zero whatever its exponent.
  if (number.mantissa.find_first_of("123456789") == std::string::npos) return number.mantissa[0] == '-' ? -0.0 : 0.0;
  return {};
}

std::string format_number(double value) {
  BRECCIA_ASSERT(std::isfinite(value));
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  BRECCIA_ASSERT(error == std::errc());
  std::string text(buffer, end);
  // "1e+06" is what C prints; "1e6" is what people write.
  if (const auto e = text.find('e'); e != std::string::npos) {
    const std::size_t digits = e + 2;
    text.erase(digits, std::min(text.find_first_not_of('0', digits), text.size() - 1) - digits);
    if (text[e + 1] == '+') text.erase(e + 1, 1);
  }
  return text;
}

}  // namespace breccia
