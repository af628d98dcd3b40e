// SPDX-License-Identifier: BSD-3-Clause
/// A new plugin's project outside Breccia's tree, made from templates.
///
/// Templates are files: `core/sdk/templates/KIND/` and `common/`, installed to share/breccia/templates. In their texts
/// and names `new_plugin_name`, `NewPluginName`, `new_plugin_kind` and `new_breccia_series` stand for what they say.
/// The line with Breccia's own licence is left out: what is written belongs to who asked for it. A file of both folders
/// is the kind's text, followed by the common one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breccia {

struct NewProject {
  std::string kind, name;
  std::filesystem::path folder;
};

/// The folder of the templates that belong to this program. UserError when they are not installed.
std::filesystem::path template_folder();

/// Why it cannot be the name of a plugin, with what to write instead; empty when it can.
std::string why_not_a_plugin_name(const std::string& name);

/// "my_law" gives "MyLaw".
std::string class_name(const std::string& plugin_name);

/// Writes the project, all of it or nothing, into a folder that does not exist or is empty. Returns its files, relative
/// to the folder. UserError for a name that cannot be, a folder that holds something, and what the system refuses.
std::vector<std::filesystem::path> make_project(const NewProject& project, const std::filesystem::path& templates);

}  // namespace breccia
