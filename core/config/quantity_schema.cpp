// SPDX-License-Identifier: BSD-3-Clause
#include "config/quantity_schema.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>

#include "config/unit_dimension.hpp"
#include "config/unit_patterns.hpp"
#include "config/units.hpp"

namespace breccia {

namespace {

const std::string number = R"([-+]?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)";

/// "a rate of pressure": `rate_of_pressure`, and so on for what has no common name.
std::string definition_name(const std::string& si_unit) {
  std::string name = si_unit == "1" ? "a plain number" : dimension_name(si_unit);
  name.erase(0, name.find(' ') + 1);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

/// With what editors say in place of the pattern.
Json text_pattern(const std::string& pattern, const std::string& otherwise) {
  return {{"pattern", pattern}, {"patternErrorMessage", otherwise}};
}

/// Editors that follow YAML 1.1 see a text in `1e5`: pure numbers may be texts as well.
Json of_dimension(const std::string& si_unit) {
  const bool plain = units::find_unit(si_unit)->dimension.empty();
  std::string slips;
  for (const std::string& slip : units_taken_for_slips()) slips += (slips.empty() ? "" : "|") + slip;
  return text_pattern(
      R"(^ *)" + number + R"( *(?!(?:)" + slips + R"() *$))" + unit_pattern(si_unit) + (plain ? "?" : "") + R"( *$)",
      needed_quantity(si_unit) + " is needed");
}

/// Units only scale a number, but for temperatures.
bool has_sign_of_number(const std::string& si_unit) { return !units::find_unit(si_unit)->dimension.contains("K"); }

void add_sign(const ParamSpec& spec, Json& all, SchemaDefinitions& definitions) {
  if (!spec.lower || spec.lower->value < 0 || !has_sign_of_number(spec.unit)) return;
  if (spec.lower->value > 0 || !spec.lower->inclusive)
    all.push_back(definitions.ref(
        "above_0", [] { return text_pattern(R"(^ *\+?(?=[0-9]*\.?[0-9]*[1-9])[0-9.])", "must be above 0"); }));
  else
    all.push_back(definitions.ref(
        "not_below_0", [] { return text_pattern(R"(^ *(?:\+?[0-9.]|-[0.]+(?![0-9.])))", "must not be below 0"); }));
}

/// Of what is written with a point rather than an exponent: that is how shares are written.
void add_share(const ParamSpec& spec, Json& all, SchemaDefinitions& definitions) {
  if (!spec.upper || spec.upper->value != 1) return;
  const bool all_of_it = spec.upper->inclusive;
  const std::string percents = R"((?:[1-9][0-9]{3,}|[2-9][0-9]{2}|1(?:0[1-9]|[1-9][0-9])|100\.0*[1-9])[0-9.]*)",
                    ones = R"((?:[2-9]|[1-9][0-9]+|1\.0*[1-9])[0-9.]*)";
  const auto refused = [&](const std::string& above, const std::string& just) {
    return all_of_it ? above : "(?:" + above + "|" + just + R"((?:\.0*)?))";
  };
  all.push_back(definitions.ref(all_of_it ? "at_most_1" : "below_1", [&] {
    return text_pattern(
        R"(^(?! *\+?(?:)" + refused(percents, "100") + R"( *(?:%|percent)|)" + refused(ones, "1") + R"() *$))",
        all_of_it ? "must be at most 1, or 100 %" : "must be below 1, or 100 %");
  }));
}

void add_bounds(const ParamSpec& spec, Json& schema) {
  if (spec.lower) schema[spec.lower->inclusive ? "minimum" : "exclusiveMinimum"] = spec.lower->value;
  if (spec.upper) schema[spec.upper->inclusive ? "maximum" : "exclusiveMaximum"] = spec.upper->value;
}

}  // namespace

Json quantity_schema(const ParamSpec& spec, SchemaDefinitions& definitions) {
  const bool plain = spec.unit == "1";
  Json schema = {{"type", plain ? Json::array({"number", "string"}) : Json("string")}};
  if (plain) add_bounds(spec, schema);
  Json all = Json::array({definitions.ref(definition_name(spec.unit), [&] { return of_dimension(spec.unit); })});
  add_sign(spec, all, definitions);
  if (plain) add_share(spec, all, definitions);
  schema["allOf"] = all;
  return schema;
}

/// `1e6` is a text for editors that follow YAML 1.1.
Json integer_schema(const ParamSpec& spec, SchemaDefinitions& definitions) {
  Json schema = {{"type", Json::array({"integer", "string"})}};
  add_bounds(spec, schema);
  schema["allOf"] = Json::array({definitions.ref("whole_number", [] {
    Json whole = text_pattern(R"(^[-+]?[0-9]+\.?[0-9]*[eE]\+?[0-9]+$)", "a whole number is needed, without quotes");
    whole["minimum"] = double(std::numeric_limits<std::int64_t>::min());
    whole["exclusiveMaximum"] = 9223372036854775808.0;
    return whole;
  })});
  return schema;
}

}  // namespace breccia
