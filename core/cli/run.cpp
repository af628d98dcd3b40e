// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "cli/console.hpp"
#include "cli/results_table.hpp"
#include "cli/verbs.hpp"
#include "output/results_folder.hpp"
#include "run/packing_cache.hpp"

namespace breccia::cli {
int run(const RunArguments& a) {
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  Console console(a.threads > 0 ? a.threads : cores);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  const LoadedWorkflow loaded = load_workflow(a.file, a.overrides, registry, a.variant);
  const std::filesystem::path folder =
      a.output.empty() ? std::filesystem::path("results") / loaded.workflow.name : a.output;
  ResultsFolder results(folder, a.overwrite, console);
  console.log_to(results.work() / "run.log");
  console.info(
      fmt::format("breccia {}: workflow `{}` into {}", BRECCIA_VERSION, loaded.workflow.name, folder.string()));
  if (results.replaces_finished())
    console.info(fmt::format("until they are whole, the new results grow in {}", results.work().string()));
  try {
    // What was stopped on request does not take the place of what had finished.
    bool apart = false;
    const auto whole = [&](bool stopped) {
      apart = stopped && results.replaces_finished();
      if (apart) return results.work();
      results.take_over(!stopped);
      return results.path();
    };
    const RunOutcome outcome = run_workflow(loaded, registry, {results.work(), default_cache_folder(), whole}, console);
    if (!apart) results.take_over(outcome.failure.empty() && !outcome.summary["interrupted"].get<bool>());
    console.clear_bar();
    print_results(outcome.summary);
    console.info(fmt::format(
        "{} in {:.1f} s; results in {}",
        !outcome.failure.empty() ? "ended before its time"
        : outcome.interrupted    ? "stopped on request"
                                 : "finished",
        outcome.summary["wall_time_s"].get<double>(),
        apart ? results.work().string() + " (the earlier ones, which had finished, are kept)" : folder.string()));
    if (!outcome.failure.empty()) return bad_input;
    return outcome.interrupted ? interrupted : ok;
  } catch (const std::exception& e) {
    console.clear_bar();
    console.log_only(std::string("ended: ") + e.what());
    throw;
  }
}

}  // namespace breccia::cli
