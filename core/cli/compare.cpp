// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare.hpp"

#include <algorithm>

#include "cli/console.hpp"
#include "cli/renderer_settings.hpp"
#include "cli/verbs.hpp"
#include "results/results_folder.hpp"

namespace breccia::cli {
namespace {

/// None when the user named no renderer and this installation has no pictures.
std::optional<PluginChoice> charts(const CompareArguments& a, const Registry& registry, Host& host) {
  std::string type = a.renderer;
  if (type.empty()) {
    type = "pictures";
    const std::vector<std::string> names = registry.names("renderer");
    if (std::find(names.begin(), names.end(), type) == names.end()) {
      if (!a.overrides.empty()) throw UserError("--set has no effect: the renderer `pictures` is not installed");
      host.warn("no charts: the renderer `pictures` is not installed");
      return {};
    }
  }
  return renderer_settings(type, a.overrides, registry);
}

}  // namespace

int compare(const CompareArguments& a) {
  Console console(1);
  for (const auto& folder : a.folders) {
    complete_results(folder, console);
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cases", none))
      complete_results(entry.path(), console);
  }
  const std::vector<ComparedRun> runs = read_runs(a.folders, a.labels);
  Registry registry;
  const auto made = compare_runs(runs, {a.output, a.overwrite, charts(a, registry, console)}, registry, console);
  for (const auto& file : made) console.info("made " + file.string());
  return ok;
}

}  // namespace breccia::cli
