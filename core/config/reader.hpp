// SPDX-License-Identifier: BSD-3-Clause
/// From the text of a workflow to a checked configuration in SI units.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "config/plugin_directory.hpp"
#include "config/problem.hpp"

namespace breccia {

/// Reads a workflow against its schema. The result satisfies `root`: SI numbers, all defaults filled in (those of
/// plugin sections too), members in the order of their declaration, absent optional members left out, paths absolute
/// (relative ones start at the folder of `file_name`; those of `overrides` as well).
///
/// `overrides` are of the form "path=value" and replace values of the file. The plugins' own rules run on the sections
/// that are otherwise in order, `root_rules` when everything else is.
///
/// All problems are found in one pass and thrown as one ConfigError.
Json read_config(const std::string& yaml_text, const std::string& file_name, const ParamSpec& root,
                 const PluginDirectory& plugins, const std::vector<std::string>& overrides = {},
                 const std::function<Issues(const Json&)>& root_rules = {});

}  // namespace breccia
