// SPDX-License-Identifier: BSD-3-Clause
/// Single values: quantities, integers, booleans, choices, texts, paths.
#include <charconv>
#include <cmath>

#include "config/number.hpp"
#include "config/section_reader.hpp"
#include "config/shorthand.hpp"
#include "config/suggest.hpp"
#include "config/text.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

/// A bound in the unit that the user wrote, where that gives a short number, else in SI.
std::string bound_text(const Bound& bound, const Quantity& written, const std::string& si_unit) {
  if (written.unit.empty() || written.offset != 0) return format_quantity(bound.value, si_unit);
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.12g", bound.value / written.factor);
  std::string number = buffer;
  if (const auto decimal = scan_decimal(number))
    if (const auto value = to_double(*decimal)) number = format_number(*value);
  return number.size() <= 8 ? number + " " + written.unit : format_quantity(bound.value, si_unit);
}

/// Why `value` is out of range, or empty. `text` prints a bound.
template <class Text>
std::string range_problem(const ParamSpec& spec, double value, const std::string& written, Text&& text) {
  std::string problem;
  if (spec.lower && !(spec.lower->inclusive ? value >= spec.lower->value : value > spec.lower->value))
    problem = (spec.lower->inclusive ? "must be at least " : "must be above ") + text(*spec.lower);
  else if (spec.upper && !(spec.upper->inclusive ? value <= spec.upper->value : value < spec.upper->value))
    problem = (spec.upper->inclusive ? "must be at most " : "must be below ") + text(*spec.upper);
  return problem.empty() ? problem : problem + ", not " + in_ticks(written);
}

}  // namespace

std::string example_line(const ParamSpec& spec) {
  std::string value = spec.example;
  if (value.empty() && !spec.choices.empty()) value = spec.choices.front().name;
  return value.empty() ? std::string() : spec.name + ": " + value;
}

namespace {

/// What stands for a value in the pattern of a line.
std::string placeholder(const ParamSpec& spec) { return spec.type == ParamType::path ? "FILE" : "VALUE"; }

}  // namespace

std::string wanted_value(const ParamSpec& spec) {
  switch (spec.type) {
    case ParamType::quantity:
      return dimension_name(spec.unit) + (spec.per_bond ? ", or a distribution" : "");
    case ParamType::quantity_list:
      return "a list (`[..., ...]`), each item " + dimension_name(spec.unit);
    case ParamType::integer:
      return "a whole number";
    case ParamType::boolean:
      return "`true` or `false`";
    case ParamType::text:
      return "a text";
    case ParamType::choice:
      return "one of its names";
    case ParamType::path:
      return "the name of a file";
    case ParamType::text_list:
      return "a list (`[..., ...]`) of texts";
    case ParamType::group:
      return "a mapping (`key: value` lines)";
    case ParamType::group_list:
      if (const ParamSpec* key = shorthand_member(spec))
        return "a list of `- " + key->name + ": " + placeholder(*key) + "` or `- " + placeholder(*key) + "` items";
      return "a list (`- ` items) of mappings";
    case ParamType::plugin:
      return "a mapping that begins with `type: NAME`";
    case ParamType::plugin_stack:
      return "a mapping that begins with `type: NAME`, or a list of such";
    case ParamType::plugin_list:
      return "a list of items that begin with `- type: NAME`";
    case ParamType::group_map:
      return "a mapping of names to mappings (`NAME: {key: value}`)";
    case ParamType::quantity_map:
      return "a mapping of names to values, each " + dimension_name(spec.unit);
    case ParamType::free_form:
      return "a mapping (`key: value` lines)";
  }
  return {};
}

Json SectionReader::read_scalar(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  if (node.kind != YamlNode::Kind::scalar) {
    report(node.place, site.path,
           "must be " + wanted_value(spec) + ", not a " + (node.kind == YamlNode::Kind::sequence ? "list" : "mapping"));
    return nullptr;
  }
  switch (spec.type) {
    case ParamType::quantity:
      return read_quantity_value(spec, node, site);
    case ParamType::integer:
      return read_integer(spec, node, site);
    case ParamType::boolean:
      return read_boolean(node, site);
    case ParamType::choice:
      return read_choice(spec, node, site);
    case ParamType::path:
      return read_path(node, site);
    default:
      return node.text;
  }
}

Json SectionReader::read_quantity_value(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  try {
    const Quantity quantity = read_quantity(node.text, spec.unit);
    const auto text = [&](const Bound& bound) { return bound_text(bound, quantity, spec.unit); };
    if (const std::string problem = range_problem(spec, quantity.si, node.text, text); !problem.empty())
      report(node.place, site.path, problem);
    return quantity.si;
  } catch (const UserError& error) {
    report(node.place, site.path, error.what());
    return nullptr;
  }
}

Json SectionReader::read_integer(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  const auto refuse = [&](const std::string& why) {
    report(node.place, site.path, in_ticks(node.text) + " " + why);
    return nullptr;
  };
  constexpr const char* too_large =
      "is too large for a whole number: the largest is 9223372036854775807, in digits alone";
  const auto number = scan_decimal(node.text);
  if (!node.plain) return refuse("is a text because of its quotes; a whole number stands without them");
  if (!number || number->length != node.text.size()) return refuse("is not a whole number");
  if (has_leading_zero(*number))
    return refuse("begins with a zero, which some programs take for octal; leave the zero out");
  const Json value = plain_json(node);  // exact up to 64 bits when written with digits alone
  Json whole = value;
  if (value.is_number_float()) {
    const double x = value.get<double>();
    if (std::floor(x) != x) return refuse("is not a whole number");
    if (std::abs(x) > 9007199254740992.0) return refuse(too_large);
    whole = std::int64_t(x);
  } else if (!value.is_number() || value.is_number_unsigned()) {  // unsigned: above what a signed one holds
    return refuse(too_large);
  }
  const auto text = [](const Bound& bound) { return format_number(bound.value); };
  if (const std::string problem = range_problem(spec, whole.get<double>(), node.text, text); !problem.empty())
    report(node.place, site.path, problem);
  return whole;
}

Json SectionReader::read_boolean(const YamlNode& node, const Site& site) {
  if (node.plain && (node.text == "true" || node.text == "false")) return node.text == "true";
  report(node.place, site.path,
         in_ticks(node.text) + " is neither `true` nor `false`" + (node.plain ? "" : "; leave the quotes out"));
  return nullptr;
}

Json SectionReader::read_choice(const ParamSpec& spec, const YamlNode& node, const Site& site) {
  std::vector<std::string> names;
  for (const Choice& choice : spec.choices) {
    if (choice.name == node.text) return node.text;
    names.push_back(choice.name);
  }
  const std::string near = closest(node.text, names);
  report(node.place, site.path,
         in_ticks(node.text) + " is not one of " + list_of(names, 30) +
             (near.empty() ? "" : "; did you mean " + in_ticks(near) + "?"));
  return nullptr;
}

Json SectionReader::read_path(const YamlNode& node, const Site& site) {
  if (node.text.empty()) {
    report(node.place, site.path, "is empty; the name of a file is needed");
    return nullptr;
  }
  const InputFile& file = files_[in_base(node.place) ? std::size_t(node.place.source) : 0];
  return (file.folder / node.text).lexically_normal().string();
}

}  // namespace breccia
