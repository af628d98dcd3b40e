// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_to_results.hpp"

#include <fmt/format.h>

#include <optional>

#include "results/results_folder.hpp"
#include "run/load_workflow.hpp"
#include "run/on_ranks.hpp"
#include "run/packing_cache.hpp"
#include "run/what_is_kept.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

RunInFolder run_into(ResultsFolder& results, const fs::path& folder, const LoadedWorkflow& loaded,
                     const Registry& registry, ResumePoint* resume, const RunRequest& asked, Terminal& terminal) {
  // What was stopped on request does not take the place of what had finished.
  bool apart = false;
  const auto whole = [&](bool stopped) {
    apart = stopped && results.replaces_finished();
    if (apart) return results.work();
    results.take_over(!stopped);
    return results.path();
  };
  const RunOptions options{results.work(), default_cache_folder(),       whole,
                           resume,         asked.accept_changed_plugins, [&] { results.refuse_if_gone(); },
                           asked.link};
  RunInFolder end{run_workflow(loaded, registry, options, terminal), {}, {}};
  const RunOutcome& outcome = end.outcome;
  try {
    if (!apart) results.take_over(outcome.failure.empty() && !outcome.summary["interrupted"].get<bool>());
  } catch (const FolderGone&) { throw; } catch (const UserError& e) {  // all else is there since `whole`
    terminal.warn(
        std::string("the results are whole, but their pictures are not there (`breccia render` draws them): ") +
        e.what());
  }
  end.place = apart ? results.work().string() + " (the earlier ones, which had finished, are kept)" : folder.string();
  if (!outcome.failure.empty()) end.kept = what_is_kept(apart ? results.work() : folder, folder);
  return end;
}

}  // namespace

std::vector<std::string> all_overrides(const RunRequest& a) {
  std::vector<std::string> overrides = a.overrides;
  if (!a.from.empty()) overrides.push_back("from.checkpoint=" + Json(fs::absolute(a.from).string()).dump());
  return overrides;
}

RunInFolder run_to_results(const RunRequest& a, Registry& registry, Terminal& terminal) {
  std::optional<ResumePoint> resume;
  if (!a.resume.empty()) resume = find_resume_point(a.resume, terminal, a.link);
  const LoadedWorkflow loaded =
      load_workflow(resume ? resume->resolved : a.file, all_overrides(a), registry, a.variant);
  const fs::path folder = resume ? a.resume : a.output.empty() ? fs::path("results") / loaded.workflow.name : a.output;
  FolderRules rules;
  rules.overwrite = a.overwrite;
  rules.go_on = resume.has_value();
  ResultsFolder results(folder, rules, terminal);
  terminal.log_to(results.work() / "run.log", resume.has_value());
  terminal.info(
      fmt::format("breccia {}: workflow `{}` into {}", BRECCIA_VERSION, loaded.workflow.name, folder.string()));
  if (results.replaces_finished())
    terminal.info(fmt::format("until they are whole, the new results grow in {}", results.work().string()));
  try {
    return run_into(results, folder, loaded, registry, resume ? &*resume : nullptr, a, terminal);
  } catch (const std::exception& e) {
    terminal.clear_bar();
    terminal.log_only(std::string("ended: ") + e.what());
    const std::string kept = what_is_kept(results.work(), folder);
    if (kept.empty() || !dynamic_cast<const UserError*>(&e) || dynamic_cast<const FolderGone*>(&e)) throw;
    throw UserError(std::string(e.what()) + "\n" + kept);
  }
}

}  // namespace breccia
