// SPDX-License-Identifier: BSD-3-Clause
/// Units of declarations are SI, which the compiler sees to: a parameter declared in "MPa" would be read right, and
/// reach its plugin a million times too large.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace breccia {
namespace detail {

/// Not constexpr: a unit that comes here ends the compilation, with this name.
inline void a_unit_must_be_in_SI_like_Pa_or_kg_per_m3_written_kg_slash_m3() {}

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_si_symbol(std::string_view s) {
  for (const std::string_view known : {"m", "kg", "s", "A", "K", "mol", "cd", "rad", "N", "Pa", "J", "W", "Hz"})
    if (s == known) return true;
  return false;
}
/// Symbols with exponents, separated by blanks, at most one stroke: "1", "N/m", "kg/m3", "N m/rad", "1/s".
constexpr bool is_si(std::string_view unit) {
  std::size_t strokes = 0, at = 0;
  while (true) {
    const std::size_t begin = at;
    while (at < unit.size() && unit[at] != ' ' && unit[at] != '/') ++at;
    std::string_view term = unit.substr(begin, at - begin);
    if (term != "1" || strokes > 0) {
      while (!term.empty() && is_digit(term.back())) term.remove_suffix(1);
      if (!is_si_symbol(term)) return false;
    }
    if (at == unit.size()) return true;
    if (unit[at] == '/' && ++strokes > 1) return false;
    ++at;
  }
}

}  // namespace detail

/// A unit as it is written in a declaration, in SI.
class SiUnit {
 public:
  template <std::size_t N>
  consteval SiUnit(const char (&text)[N]) : text_(text) {
    if (!detail::is_si(text_)) detail::a_unit_must_be_in_SI_like_Pa_or_kg_per_m3_written_kg_slash_m3();
  }
  constexpr std::string_view text() const { return text_; }
  operator std::string() const { return std::string(text_); }

 private:
  std::string_view text_;
};

}  // namespace breccia
