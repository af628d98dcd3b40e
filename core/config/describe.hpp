// SPDX-License-Identifier: BSD-3-Clause
/// What a plugin is and takes, from the same declarations that check its section: for the terminal, for the manual and
/// for programs.
#pragma once

#include <string>

#include "breccia/schema.hpp"

namespace breccia {

std::string describe_text(const std::string& kind, const std::string& name, const Documentation& doc);
std::string describe_markdown(const std::string& kind, const std::string& name, const Documentation& doc);
/// Members: kind, name, summary, details, source, licence, parameters (name, type, unit, doc, source, example,
/// required, default, lower, upper, choices, min_items, max_items, plugin_kind, parameters), exactly_one_of,
/// at_most_one_of, removed. What does not apply is left out. Numbers are SI.
Json describe_json(const std::string& kind, const std::string& name, const Documentation& doc);

/// "quantity", "integer", "plugin_list": the name of a type in `describe_json`.
std::string type_name(ParamType type);
/// "above 0 Pa, at most 1e9 Pa"; empty when anything goes.
std::string range_text(const ParamSpec& spec);
/// The default as a workflow would have it, on one line; empty without one.
std::string default_text(const ParamSpec& spec);

}  // namespace breccia
