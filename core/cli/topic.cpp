// SPDX-License-Identifier: BSD-3-Clause
#include "cli/topic.hpp"

#include <algorithm>

#include "calibrate/calibration.hpp"
#include "cli/plugin_name.hpp"
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

template <class Config>
Documentation keys_of() {
  Schema<Config> schema;
  Config::describe(schema);
  return schema.documentation();
}

}  // namespace

Topic topic_named(const Registry& registry, const std::string& written) {
  if (written == "workflow") return {"", written, keys_of<Workflow>()};
  if (written == "sweep") return {"", written, keys_of<Study>()};
  if (written == "calibration") return {"", written, keys_of<Calibration>()};
  const auto [kind, name] =
      plugin_named(registry, written, {"workflow", "sweep", "calibration"},
                   "describe takes KIND/NAME (see `breccia list`), NAME, KIND, `workflow`, `sweep` or `calibration`");
  Topic topic{kind, name, registry.documentation(kind, name)};
  if (is_listed(kind)) topic.doc.root = as_listed(topic.doc.root);
  const PluginInfo& info = registry.info(kind, name);
  if (!is_shipped(info)) {
    topic.origin = "file: " + info.file.string() + "\nversion: " + info.version + "\n";
    // The schema's own default is Breccia's licence: of another author's plugin it says nothing.
    if (topic.doc.licence == Documentation().licence) topic.doc.licence.clear();
  }
  return topic;
}

}  // namespace breccia::cli
