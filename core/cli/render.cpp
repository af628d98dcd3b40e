// SPDX-License-Identifier: BSD-3-Clause
#include "run/render.hpp"

#include <fmt/format.h>

#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "plugin/drawing.hpp"
#include "results/results_folder.hpp"
#include "run/load_workflow.hpp"

namespace breccia::cli {
namespace {

namespace fs = std::filesystem;

/// Those that the run's own workflow had if it used this renderer; else the defaults with --set on top.
std::vector<PluginChoice> settings(const RenderArguments& a, Registry& registry) {
  const fs::path resolved = a.source / "resolved.yaml";
  if (fs::is_directory(a.source) && fs::exists(resolved)) {
    const LoadedWorkflow loaded = load_workflow(resolved, {}, registry);
    std::vector<PluginChoice> own;
    for (const PluginChoice& r : loaded.workflow.renderers)
      if (r.type == a.renderer && a.overrides.empty()) own.push_back(r);
    if (!own.empty()) return own;
  }
  return {renderer_settings(a.renderer, a.overrides, registry)};
}

}  // namespace

int render(const RenderArguments& a) {
  if (!fs::exists(a.source)) throw UserError("cannot read " + a.source.string() + ": no such file or folder");
  Console console(1);
  complete_results(fs::is_directory(a.source) ? a.source : fs::absolute(a.source).parent_path(), console);
  Registry registry;
  const fs::path folder = !a.output.empty()            ? a.output
                          : fs::is_directory(a.source) ? a.source
                                                       : fs::absolute(a.source).parent_path();
  const std::vector<PluginChoice> choices = settings(a, registry);
  std::optional<FolderLock> lock;  // a folder that is yet to be made has no run in it
  if (fs::is_directory(folder)) lock.emplace(folder, console);
  const auto made = render_apart(choices, registry, {a.source, folder}, a.overwrite, console);
  for (const fs::path& file : made) console.info("picture " + file.string());
  return made.empty() ? failure : ok;
}

}  // namespace breccia::cli
