// SPDX-License-Identifier: BSD-3-Clause
#include "config/unit_syntax.hpp"

#include <cctype>

#include "breccia/utf8.hpp"
#include "config/text.hpp"

namespace breccia {

namespace {

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || (c & 0x80) || c == '%' || c == '_' || c == '\'';
}

/// Moves past `^2`, `**2`, `-1`, `2` after a unit's name. False when it is not a whole number of one digit.
bool skip_exponent(std::string_view unit, std::size_t& at) {
  const std::size_t from = at;
  if (unit.substr(at, 2) == "**") at += 2;
  else if (at < unit.size() && unit[at] == '^') ++at;
  const bool marked = at > from;
  const std::size_t sign = at;
  if (at < unit.size() && (unit[at] == '-' || unit[at] == '+')) ++at;
  if (at < unit.size() && is_digit(unit[at])) {
    ++at;
    const bool more =
        at < unit.size() && (is_digit(unit[at]) || (unit[at] == '.' && at + 1 < unit.size() && is_digit(unit[at + 1])));
    return !more;
  }
  at = sign;  // `N-m`: the hyphen joins two units
  return !marked;
}

/// "1/s"
bool starts_one_over(std::string_view unit) {
  const std::size_t next = unit.starts_with('1') ? unit.find_first_not_of(' ', 1) : unit.npos;
  return next != unit.npos && unit[next] == '/';
}

}  // namespace

std::string unit_syntax_problem(std::string_view unit) {
  const std::string quoted = "`" + std::string(unit) + "`";
  for (std::size_t at = 0, length; at < unit.size(); at += length) {
    length = utf8_length(unit.substr(at));
    if (length == 0) return "the unit is not a text in UTF-8";
    const std::string_view character = unit.substr(at, length);
    if (character == "\u00A0" || character == "\u2009" || character == "\u202F")
      return quoted + " is not a unit: it contains a special space; write an ordinary one";
  }
  int open = 0;
  for (std::size_t at = 0; at < unit.size();) {
    const char c = unit[at];
    if (is_letter(c)) {
      while (at < unit.size() && is_letter(unit[at])) ++at;
      if (!skip_exponent(unit, at)) return quoted + " is not a unit: exponents are whole numbers such as `m2` or `s-1`";
    } else if (c == ' ' || c == '.' || c == '*' || c == '/' || c == '-' || (at == 0 && starts_one_over(unit))) {
      ++at;
    } else if (is_digit(c)) {
      return quoted + " is not a unit: numbers stand in it only as exponents, such as `m2`";
    } else if (c == '(' || c == ')') {
      open += c == '(' ? 1 : -1;
      if (open < 0) break;
      ++at;
    } else {
      return quoted + " is not a unit: `" + std::string(1, c) + "` has no meaning in it";
    }
  }
  if (open != 0) return quoted + " is not a unit: its parentheses do not match";
  return {};
}

}  // namespace breccia
