// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "cli/console.hpp"
#include "cli/results_table.hpp"
#include "cli/verbs.hpp"
#include "results/results_folder.hpp"
#include "run/load_workflow.hpp"
#include "run/packing_cache.hpp"
#include "run/runner.hpp"
#include "run/what_is_kept.hpp"

namespace breccia::cli {
int run(const RunArguments& a) {
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  Console console(a.threads > 0 ? a.threads : cores);
  Registry registry;
  for (const std::string& w : registry.warnings()) console.warn(w);
  std::optional<ResumePoint> resume;
  if (!a.resume.empty()) resume = find_resume_point(a.resume, console);
  std::vector<std::string> overrides = a.overrides;
  if (!a.from.empty())
    overrides.push_back("from.checkpoint=" + Json(std::filesystem::absolute(a.from).string()).dump());
  const LoadedWorkflow loaded = load_workflow(resume ? resume->resolved : a.file, overrides, registry, a.variant);
  const std::filesystem::path folder = resume             ? a.resume
                                       : a.output.empty() ? std::filesystem::path("results") / loaded.workflow.name
                                                          : a.output;
  FolderRules rules;
  rules.overwrite = a.overwrite;
  rules.go_on = resume.has_value();
  ResultsFolder results(folder, rules, console);
  console.log_to(results.work() / "run.log", resume.has_value());
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
    const RunOptions options{
        results.work(),           default_cache_folder(),           whole, resume ? &*resume : nullptr,
        a.accept_changed_plugins, [&] { results.refuse_if_gone(); }};
    const RunOutcome outcome = run_workflow(loaded, registry, options, console);
    try {
      if (!apart) results.take_over(outcome.failure.empty() && !outcome.summary["interrupted"].get<bool>());
    } catch (const FolderGone&) { throw; } catch (const UserError& e) {  // all else is there since `whole`
      console.warn(
          std::string("the results are whole, but their pictures are not there (`breccia render` draws them): ") +
          e.what());
    }
    console.clear_bar();
    print_results(outcome.summary);
    console.info(fmt::format(
        "{} in {:.1f} s; results in {}",
        !outcome.failure.empty() ? "ended before its time"
        : outcome.interrupted    ? "stopped on request"
                                 : "finished",
        outcome.summary["wall_time_s"].get<double>(),
        apart ? results.work().string() + " (the earlier ones, which had finished, are kept)" : folder.string()));
    if (!outcome.failure.empty()) {
      console.info("why: " + outcome.failure);
      if (const std::string kept = what_is_kept(apart ? results.work() : folder, folder); !kept.empty())
        console.info(kept);
      return bad_input;
    }
    return outcome.interrupted ? interrupted : ok;
  } catch (const std::exception& e) {
    console.clear_bar();
    console.log_only(std::string("ended: ") + e.what());
    const std::string kept = what_is_kept(results.work(), folder);
    if (kept.empty() || !dynamic_cast<const UserError*>(&e) || dynamic_cast<const FolderGone*>(&e)) throw;
    throw UserError(std::string(e.what()) + "\n" + kept);
  }
}

}  // namespace breccia::cli
