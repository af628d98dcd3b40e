// SPDX-License-Identifier: BSD-3-Clause
/// What is known of one parameter, whatever type the plugin keeps it in: the tree that parsing, checking, `describe`,
/// the documentation and the JSON Schema go by. Made by `Schema`.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace breccia {

using Json = nlohmann::ordered_json;

enum class ParamType {
  quantity,       ///< number with a unit ("10 GPa"); JSON number in SI
  quantity_list,  ///< sequence of quantities of one unit; JSON array
  integer,
  boolean,
  text,
  choice,        ///< one of `choices`; JSON string
  path,          ///< a file, relative to the workflow; JSON string, made absolute by the parser
  group,         ///< mapping with `members`; JSON object
  group_list,    ///< sequence of such mappings; JSON array
  group_map,     ///< such mappings by names that the user chooses; JSON object
  quantity_map,  ///< quantities of one unit by names that the user chooses; JSON object
  plugin,        ///< mapping with `type: NAME` and that plugin's own parameters; JSON object with "type"
  plugin_list,
  plugin_stack,  ///< one plugin, or a list of them; JSON object or array
  free_form,     ///< any mapping, kept as it stands (reference values); JSON object
  text_list      ///< sequence of texts; JSON array
};

struct Bound {
  double value;
  bool inclusive;
};

struct Choice {
  std::string name, doc;
};

/// Everything that is known of one parameter.
struct ParamSpec {
  std::string name;
  ParamType type = ParamType::quantity;
  std::string unit = "1";  ///< SI unit of the JSON value; "1" for a pure number
  std::string doc, source, example;
  bool required = true;
  Json fallback;  ///< the default, in the form of the JSON value; null: none
  std::optional<Bound> lower, upper;
  std::vector<Choice> choices;
  std::size_t min_items = 0, max_items = SIZE_MAX;                       ///< of a list
  std::string plugin_kind;                                               ///< of a plugin or plugin_list
  std::vector<ParamSpec> members;                                        ///< of a group or group_list
  std::vector<std::vector<std::string>> exactly_one_of, at_most_one_of;  ///< among `members`
  bool changes_section = false;  ///< of a group_list: each item changes the section it stands in, for a case of it
  bool per_bond = false;  ///< of a quantity: may be a distribution instead, of which each bond draws its own value
  std::map<std::string, std::string> removed;  ///< retired member -> what to write instead

  /// Of a plugin_stack: what it is when a list was given, or a single plugin.
  ParamSpec as_given(bool list) const {
    ParamSpec form = *this;
    form.type = list ? ParamType::plugin_list : ParamType::plugin;
    form.min_items = 1;
    return form;
  }
};

/// What `describe` prints of a plugin, and what its section in a workflow must look like.
struct Documentation {
  std::string summary;  ///< one line
  std::string details;  ///< Markdown: equations, choices made
  std::string source;   ///< paper and equations
  std::string licence = "BSD-3-Clause";
  ParamSpec root;  ///< a group
};

/// A plugin picked in the workflow: its name and its checked parameters.
struct PluginChoice {
  std::string type;
  Json config = Json::object();
};

/// One plugin, or several that act together, in their order; never none.
struct PluginStack {
  std::vector<PluginChoice> plugins;
  std::string names(const char* between = " + ") const {
    std::string text;
    for (const PluginChoice& p : plugins) text += (text.empty() ? "" : between) + p.type;
    return text;
  }
};

}  // namespace breccia
