// SPDX-License-Identifier: BSD-3-Clause
/// From the text of a workflow to a checked configuration in SI units.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/base_chain.hpp"
#include "config/places.hpp"
#include "config/plugin_directory.hpp"
#include "config/problem.hpp"

namespace breccia {

/// Reads a workflow against its schema. The result satisfies `root`: SI numbers, all defaults filled in (those of
/// plugin sections too), members in the order of their declaration, absent optional members left out, paths absolute
/// (relative ones start at the folder of the file in which they are written; those of `overrides` and defaults at that
/// of the workflow).
///
/// The files of the chain are merged first (see `merge`); a base need not be complete, only the result is checked. It
/// holds nothing of `base`. `overrides` are of the form "path=value" and replace values of what was merged. The
/// plugins' own rules run on the sections that are otherwise in order, `root_rules` when everything else is.
///
/// `variant` names a member of the mapping `variants` of the merged files, which is laid over them like a file over its
/// base, before the overrides; the result holds nothing of `variants`.
///
/// All problems are found in one pass and thrown as one ConfigError. `places`: gets to know where the values stand.
Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const std::vector<std::string>& overrides = {},
                 const std::function<Issues(const Json&)>& root_rules = {}, const std::string& variant = {},
                 Places* places = nullptr);

/// Names of the variants that the files of the chain offer together, in order of the alphabet.
std::vector<std::string> variants_of(const BaseChain& chain);

/// The same with the values that a study gives in place of those of the command line. Relative paths in them start at
/// the study's folder.
Json read_config(const BaseChain& chain, const ParamSpec& root, const PluginDirectory& plugins,
                 const ValuesOnTop& on_top, const std::function<Issues(const Json&)>& root_rules = {},
                 Places* places = nullptr);

/// One member of `root` alone, by the same way of merging, variant and overrides included, and in the same form: for
/// what must be known before the plugins are (the section that names them). Null when it is absent or not in order,
/// which `read_config` then reports with everything else; nothing in it may depend on a plugin.
Json read_section(const BaseChain& chain, const ParamSpec& root, const std::string& name,
                  const std::vector<std::string>& overrides = {}, const std::string& variant = {});
Json read_section(const BaseChain& chain, const ParamSpec& root, const std::string& name, const ValuesOnTop& on_top);

/// What was found, in the order of the places, of which `files` are the sources.
std::vector<Problem> problems_of(std::vector<Finding> findings, const std::vector<InputFile>& files);

/// Throws them as a ConfigError.
[[noreturn]] void refuse(std::vector<Finding> findings, const std::vector<InputFile>& files);

/// The same for a text that stands, or might stand, in the file of that name.
Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides = {},
                 const std::function<Issues(const Json&)>& root_rules = {});

}  // namespace breccia
