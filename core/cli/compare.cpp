// SPDX-License-Identifier: BSD-3-Clause
#include "compare/compare.hpp"

#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "plugin/drawing.hpp"
#include "results/results_folder.hpp"

namespace breccia::cli {
namespace {

/// None when the user named no renderer and this installation has no pictures.
std::optional<PluginChoice> charts(const CompareArguments& a, const Registry& registry, Host& host) {
  return a.renderer.empty() ? usual_renderer(a.overrides, registry, host)
                            : renderer_settings(a.renderer, a.overrides, registry);
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
