// SPDX-License-Identifier: BSD-3-Clause
/// The part of JSON Schema (draft 7) that `json_schema` uses, as a checker. A keyword that it does not know is a
/// failure, so that nothing in a schema passes unchecked.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include "breccia/schema.hpp"

namespace breccia {

class SchemaChecker {
 public:
  /// Empty when `value` conforms, else the first reason.
  static std::string problem(const Json& root, const Json& value) {
    return SchemaChecker(root).problem(root, value, "$");
  }

 private:
  explicit SchemaChecker(const Json& root) : root_(root) {}

  std::string problem(const Json& schema, const Json& value, const std::string& at) const {
    if (schema.is_boolean()) return schema.get<bool>() ? "" : at + ": nothing is valid here";
    for (const auto& [keyword, argument] : schema.items()) {
      const std::string found = check(schema, keyword, argument, value, at);
      if (!found.empty()) return found;
    }
    return {};
  }

  static bool is_type(const std::string& type, const Json& value) {
    if (type == "integer")
      return value.is_number_integer() || (value.is_number() && std::floor(value.get<double>()) == value);
    if (type == "number") return value.is_number();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "array") return value.is_array();
    return type == "object" && value.is_object();
  }

  static const std::regex& compiled(const std::string& pattern) {
    static std::map<std::string, std::regex> all;
    const auto found = all.find(pattern);
    return found != all.end() ? found->second : all.emplace(pattern, std::regex(pattern)).first->second;
  }

  std::string check(const Json& schema, const std::string& keyword, const Json& argument, const Json& value,
                    const std::string& at) const {
    const auto fail_if = [&](bool wrong) {
      return wrong ? at + ": " + keyword + " " + argument.dump() + " against " + value.dump() : "";
    };
    if (keyword == "type") {
      if (argument.is_string()) return fail_if(!is_type(argument, value));
      return fail_if(std::none_of(argument.begin(), argument.end(), [&](const Json& t) { return is_type(t, value); }));
    }
    if (keyword == "const") return fail_if(value != argument);
    if (keyword == "pattern")
      return fail_if(value.is_string() && !std::regex_search(value.get<std::string>(), compiled(argument)));
    if (keyword == "minLength") return fail_if(value.is_string() && value.get<std::string>().size() < argument);
    if (keyword == "$ref")
      return problem(root_.at("definitions").at(argument.get<std::string>().substr(sizeof "#/definitions/" - 1)), value,
                     at);
    if (keyword == "minimum") return fail_if(value.is_number() && value.get<double>() < argument.get<double>());
    if (keyword == "exclusiveMinimum")
      return fail_if(value.is_number() && value.get<double>() <= argument.get<double>());
    if (keyword == "maximum") return fail_if(value.is_number() && value.get<double>() > argument.get<double>());
    if (keyword == "exclusiveMaximum")
      return fail_if(value.is_number() && value.get<double>() >= argument.get<double>());
    if (keyword == "minItems") return fail_if(value.is_array() && value.size() < argument.get<std::size_t>());
    if (keyword == "maxItems") return fail_if(value.is_array() && value.size() > argument.get<std::size_t>());
    if (keyword == "required")
      return fail_if(value.is_object() && std::any_of(argument.begin(), argument.end(), [&](const Json& k) {
                       return !value.contains(k.get<std::string>());
                     }));
    if (keyword == "not") return fail_if(problem(argument, value, at).empty());
    if (keyword == "anyOf")
      return fail_if(
          std::none_of(argument.begin(), argument.end(), [&](const Json& s) { return problem(s, value, at).empty(); }));
    if (keyword == "allOf") return first_problem(argument, value, at);
    if (keyword == "if") {
      const char* way = problem(argument, value, at).empty() ? "then" : "else";
      return schema.contains(way) ? problem(schema.at(way), value, at) : "";
    }
    if (keyword == "items") return items_problem(argument, value, at);
    if (keyword == "properties") return members_problem(argument, value, at);
    if (keyword == "minProperties") return fail_if(value.is_object() && value.size() < argument.get<std::size_t>());
    if (!value.is_object() && (keyword == "additionalProperties" || keyword == "propertyNames")) return {};
    if (keyword == "additionalProperties") {
      for (const auto& [key, member] : value.items())
        if (!schema.contains("properties") || !schema.at("properties").contains(key))
          if (const std::string found = problem(argument, member, at + "." + key); !found.empty()) return found;
      return {};
    }
    if (keyword == "propertyNames") {
      for (const auto& [key, member] : value.items())
        if (const std::string found = problem(argument, Json(key), at + "." + key); !found.empty()) return found;
      return {};
    }
    for (const char* annotation : {"then", "else", "description", "default", "examples", "title", "$schema",
                                   "definitions", "patternErrorMessage"})
      if (keyword == annotation) return {};
    return at + ": the checker does not know " + keyword;
  }

  std::string first_problem(const Json& schemas, const Json& value, const std::string& at) const {
    for (const Json& schema : schemas)
      if (const std::string found = problem(schema, value, at); !found.empty()) return found;
    return {};
  }
  std::string items_problem(const Json& schema, const Json& value, const std::string& at) const {
    for (std::size_t k = 0; value.is_array() && k < value.size(); ++k)
      if (const std::string found = problem(schema, value[k], at + "[" + std::to_string(k) + "]"); !found.empty())
        return found;
    return {};
  }
  std::string members_problem(const Json& schemas, const Json& value, const std::string& at) const {
    for (const auto& [key, schema] : schemas.items())
      if (value.is_object() && value.contains(key))
        if (const std::string found = problem(schema, value[key], at + "." + key); !found.empty()) return found;
    return {};
  }

  const Json& root_;
};

}  // namespace breccia
