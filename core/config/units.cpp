// SPDX-License-Identifier: BSD-3-Clause
#include "config/units.hpp"

#include <cmath>

#include "config/number.hpp"
#include "config/text.hpp"
#include "config/unit_dimension.hpp"
#include "config/unit_syntax.hpp"

namespace breccia {

namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

/// "a pressure such as Pa, MPa, GPa or psi", for messages.
std::string needed(const units::Dimension& dimension, const std::string& si_unit) {
  const units::Family* family = units::family_of(dimension);
  if (!family) return "a quantity in " + in_ticks(si_unit);
  if (dimension.empty()) return std::string(family->name) + " (" + family->examples + ")";
  return std::string(family->name) + " such as " + family->examples;
}

DecimalText read_number(std::string_view text) {
  const auto number = scan_decimal(text);
  if (!number) throw UserError(in_ticks(text) + " is not a number");
  if (has_leading_zero(*number))
    throw UserError(in_ticks(text) + " begins with a zero, which some programs take for octal; leave the zero out");
  return *number;
}

/// number * factor + offset with as few roundings as there can be.
std::optional<double> convert(const DecimalText& number, double factor, double offset) {
  const auto near = [](double x, double target) { return std::abs(x - target) <= 1e-13 * std::abs(target); };
  std::optional<double> value;
  const double power = std::round(std::log10(std::abs(factor)));
  if (factor > 0 && near(factor, std::pow(10.0, power))) {
    value = to_double(number, int(power));
  } else if (value = to_double(number); value) {
    const double inverse = std::round(1 / factor), whole = std::round(factor);
    if (whole != 0 && near(factor, whole)) *value *= whole;
    else if (inverse != 0 && near(1 / factor, inverse)) *value /= inverse;
    else *value *= factor;
  }
  const bool vanished = value == 0.0 && number.mantissa.find_first_of("123456789") != std::string::npos;
  if (!value || vanished) return {};
  *value += offset;
  return std::isfinite(*value) ? value : std::nullopt;
}

[[noreturn]] void refuse_unit(std::string_view unit, const units::Unit* found, const units::Unit& wanted,
                              const std::string& si_unit) {
  const std::string similar = units::similar_unit(unit, wanted.dimension);
  const std::string hint = similar.empty() ? std::string() : "; did you mean " + in_ticks(similar) + "?";
  if (!found) {
    throw UserError(in_ticks(unit) + " is not a known unit; " + needed(wanted.dimension, si_unit) + " is needed" +
                    hint);
  }
  const units::Family* family = units::family_of(found->dimension);
  const std::string what = family ? std::string("is ") + family->name : std::string("is of another dimension");
  throw UserError(in_ticks(unit) + " " + what + "; " + needed(wanted.dimension, si_unit) + " is needed" + hint);
}

struct Slip {
  const char *written, *meant, *otherwise;
};
/// Prefixes whose case was slipped: units that exist, and that nobody means who writes of rock. Whoever does can say so
/// in another way.
constexpr Slip slips[] = {
    {"mPa", "MPa", "e-3 Pa"}, {"Mm", "mm", "e6 m"}, {"Mm/s", "mm/s", "e6 m/s"}, {"Ms", "ms", "e6 s"}};

void refuse_slip_of_case(std::string_view text, std::string_view number, std::string_view unit) {
  for (const Slip& slip : slips)
    if (unit == slip.written) {
      const std::string plain(number);
      const bool has_exponent = plain.find_first_of("eE") != std::string::npos;
      throw UserError(in_ticks(text) + " is almost surely meant as " + in_ticks(plain + " " + slip.meant) +
                      "; if it is not, write it " +
                      (has_exponent ? "without the prefix" : "as " + in_ticks(plain + slip.otherwise)));
    }
}

units::Unit unit_of_schema(const std::string& si_unit) {
  const auto unit = units::find_unit(si_unit);
  BRECCIA_ASSERT(unit && "the schema names a unit that exists");
  return *unit;
}

}  // namespace

Quantity read_quantity(std::string_view written, const std::string& si_unit) {
  const std::string_view text = trimmed(written);
  const units::Unit wanted = unit_of_schema(si_unit);
  const DecimalText number = read_number(text);
  const std::string_view rest = text.substr(number.length), unit = trimmed(rest);
  if (unit.empty() && si_unit != "1") {
    // The number as it stands is most likely meant in SI: with any other unit the advice would change its value.
    const std::string in_si = std::string(text) + " " + si_unit;
    throw UserError(in_ticks(text) + " needs a unit: write " + in_ticks(in_si) + " if that is meant; " +
                    needed(wanted.dimension, si_unit) + " is needed");
  }
  Quantity quantity;
  quantity.unit = unit;
  if (!unit.empty()) {
    const char first = unit.front();
    if (first == ',' || first == '\'' || first == '_' || (first >= '0' && first <= '9' && unit.substr(0, 2) != "1/"))
      throw UserError(in_ticks(text) + " is not one number: the decimal sign is a point, and digits are not grouped");
    if (rest.front() == '.' || rest.front() == '-' || rest.front() == '+' || rest.front() == '*' || rest.front() == '/')
      throw UserError(in_ticks(text) + " is not a number and a unit: " + in_ticks(rest) +
                      " has no meaning after the number");
    if (const std::string problem = unit_syntax_problem(unit); !problem.empty()) throw UserError(problem);
    const auto found = units::find_unit(unit);
    if (!found || found->dimension != wanted.dimension) refuse_unit(unit, found ? &*found : nullptr, wanted, si_unit);
    refuse_slip_of_case(text, text.substr(0, number.length), unit);
    quantity.factor = found->factor / wanted.factor;
    quantity.offset = (found->offset - wanted.offset) / wanted.factor;
  }
  const auto value = convert(number, quantity.factor, quantity.offset);
  if (!value) throw UserError(in_ticks(text) + " is beyond the range of numbers (about 1e-308 to 1e308 in SI units)");
  quantity.si = *value;
  return quantity;
}

double parse_quantity(std::string_view text, const std::string& si_unit) { return read_quantity(text, si_unit).si; }

std::string si_unit_of(std::string_view written) {
  const std::string_view text = trimmed(written);
  const std::string_view unit = trimmed(text.substr(read_number(text).length));
  if (unit.empty()) return "1";
  if (const std::string problem = unit_syntax_problem(unit); !problem.empty()) throw UserError(problem);
  const auto found = units::find_unit(unit);
  if (!found) throw UserError(in_ticks(unit) + " is not a known unit");
  const units::Family* family = units::family_of(found->dimension);
  if (!family)
    throw UserError(in_ticks(unit) + " measures nothing that has a name here; write the value in another unit");
  return family->si;
}

std::string format_quantity(double si, const std::string& si_unit) {
  const std::string number = format_number(si);
  return si_unit == "1" ? number : number + " " + si_unit;
}

std::string dimension_name(const std::string& si_unit) {
  const units::Family* family = units::family_of(unit_of_schema(si_unit).dimension);
  return family ? family->name : "a quantity in " + in_ticks(si_unit);
}

std::string needed_quantity(const std::string& si_unit) { return needed(unit_of_schema(si_unit).dimension, si_unit); }

std::vector<std::string> units_taken_for_slips() {
  std::vector<std::string> all;
  for (const Slip& slip : slips) all.emplace_back(slip.written);
  return all;
}

std::string usual_unit(const std::string& si_unit) {
  const units::Family* family = units::family_of(unit_of_schema(si_unit).dimension);
  return family ? family->usual : si_unit;
}

}  // namespace breccia
