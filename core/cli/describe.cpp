// SPDX-License-Identifier: BSD-3-Clause
#include "config/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "breccia/error.hpp"
#include "cli/plugin_name.hpp"
#include "cli/verbs.hpp"
#include "config/listed_plugin.hpp"
#include "study/study.hpp"
#include "workflow/workflow.hpp"

namespace breccia::cli {
namespace {

/// Whether it lies where Breccia's own plugins are, and is of this version.
bool is_shipped(const PluginInfo& info) {
  namespace fs = std::filesystem;
  for (const PluginFolder& folder : default_plugin_folders()) {
    std::error_code unknown;
    if (folder.named_by.empty() && fs::equivalent(folder.path, info.file.parent_path(), unknown))
      return info.version == BRECCIA_VERSION;
  }
  return false;
}

/// Whether workflows have a list of such plugins.
bool is_listed(const std::string& kind) {
  const auto& sections = workflow_schema().members;
  return std::any_of(sections.begin(), sections.end(),
                     [&](const ParamSpec& s) { return s.type == ParamType::plugin_list && s.plugin_kind == kind; });
}

/// The plugins of a kind with what they do.
int describe_kind(const Registry& registry, const std::string& kind, const std::string& format) {
  Json all = Json::array();
  std::string text;
  for (const std::string& name : registry.names(kind)) {
    std::string summary;
    try {
      summary = registry.documentation(kind, name).summary;
    } catch (const UserError& e) { summary = std::string("of no use: ") + e.what(); }
    all.push_back({{"name", name}, {"summary", summary}});
    text += format == "markdown" ? fmt::format("- `{}/{}`: {}\n", kind, name, summary)
                                 : fmt::format("{}/{}: {}\n", kind, name, summary);
  }
  if (format == "json") fmt::print("{}\n", Json{{"kind", kind}, {"plugins", all}}.dump(2));
  else fmt::print("{}", text.empty() ? "no " + kind + " plugin was found\n" : text);
  return ok;
}

}  // namespace

int describe(const std::string& plugin, const std::string& format) {
  Registry registry;
  std::string kind = "", name = plugin;
  std::string origin;
  Documentation doc;
  if (plugin == "workflow") {
    Schema<Workflow> schema;
    Workflow::describe(schema);
    doc = schema.documentation();
  } else if (plugin == "sweep") {
    Schema<Study> schema;
    Study::describe(schema);
    doc = schema.documentation();
  } else {
    const std::vector<std::string>& kinds = registry.kinds();
    if (std::find(kinds.begin(), kinds.end(), plugin) != kinds.end()) return describe_kind(registry, plugin, format);
    std::tie(kind, name) =
        plugin_named(registry, plugin, {"workflow", "sweep"},
                     "describe takes KIND/NAME (see `breccia list`), NAME, KIND, `workflow` or `sweep`");
    doc = registry.documentation(kind, name);
    if (is_listed(kind)) doc.root = as_listed(doc.root);
    const PluginInfo& info = registry.info(kind, name);
    if (!is_shipped(info)) {
      origin = "file: " + info.file.string() + "\nversion: " + info.version + "\n";
      // The schema's own default is Breccia's licence: of another author's plugin it says nothing.
      if (doc.licence == Documentation().licence) doc.licence.clear();
    }
  }
  if (format == "json") fmt::print("{}\n", describe_json(kind, name, doc).dump(2));
  else
    fmt::print("{}{}", format == "text" ? origin : "",
               format == "markdown" ? describe_markdown(kind, name, doc) : describe_text(kind, name, doc));
  return ok;
}

}  // namespace breccia::cli
