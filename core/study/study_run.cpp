// SPDX-License-Identifier: BSD-3-Clause
#include "study/study_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <map>

#include "plugin/drawing.hpp"
#include "results/results_folder.hpp"
#include "study/local_run.hpp"
#include "study/study_results.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

/// Those that have not finished with these inputs.
std::vector<const PlannedCase*> to_run(const SweepPlan& plan, const fs::path& folder, bool overwrite, Host& host) {
  std::vector<const PlannedCase*> open;
  std::vector<std::string> stale;
  for (const PlannedCase& c : plan.cases) {
    const CaseRecord record = read_case(case_folder(folder, c.the), c.hash, host);
    if (record.state != CaseState::finished) open.push_back(&c);
    if (record.others_there) stale.push_back(c.the.folder);
  }
  if (!stale.empty() && !overwrite)
    throw other_inputs(fmt::format("{} finished case{} in {} ({}{}) {}", stale.size(), stale.size() == 1 ? "" : "s",
                                   folder.string(), stale[0], stale.size() == 1 ? "" : ", ...",
                                   stale.size() == 1 ? "is" : "are"));
  return open;
}

/// By the folder of the case: why it failed that could not say so itself.
std::map<std::string, std::string> run_open(const StudyRequest& a, const std::vector<const PlannedCase*>& open,
                                            const ResultsFolder& home, Host& host) {
  std::vector<LocalCase> all;
  for (const PlannedCase* c : open) {
    LocalCase one{c->the.folder,
                  case_folder(home.path(), c->the),
                  c->hash,
                  {"sweep", a.study.string(), "--case", std::to_string(c->the.number), "--output", home.path().string(),
                   "--threads", std::to_string(a.threads), "--expect", c->hash, "--parent", std::to_string(getpid())}};
    if (a.overwrite) one.arguments.push_back("--overwrite");
    all.push_back(std::move(one));
  }
  return run_locally(all, home.work() / "logs", jobs_at_once(a.jobs, a.threads), host);
}

/// None when the study asks for none, or names no renderer and this installation has no pictures.
std::optional<PluginChoice> renderer_of(const Study& study, Host& host) {
  if (study.charts.empty()) return {};
  if (study.renderer) return study.renderer;
  return usual_renderer({}, Registry(), host);
}

/// Returns whether all cases have finished. `shown`: the folder as the user wrote it.
bool gather(const Sweep& sweep, const SweepPlan& plan, ResultsFolder& home, const fs::path& shown,
            const std::map<std::string, std::string>& crashes, Host& host) {
  std::vector<CaseResult> results = read_results(plan, home.path(), host);
  for (std::size_t k = 0; k < results.size(); ++k)
    if (const auto it = crashes.find(plan.cases[k].the.folder); it != crashes.end())
      results[k].record = {CaseState::failed, it->second};
  std::size_t finished = 0;
  std::string others;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const CaseRecord& record = results[k].record;
    finished += record.state == CaseState::finished;
    if (record.state != CaseState::finished)
      others += fmt::format("  case {} ({}): {}{}\n", k + 1, plan.cases[k].the.folder, state_text(record.state),
                            record.error.empty() ? "" : ": " + record.error.substr(0, record.error.find('\n')));
  }
  const SweepTable table(sweep, plan, std::move(results));
  const std::vector<fs::path> made =
      write_results(sweep, plan, table, renderer_of(sweep.study().study, host), home.work(), host);
  home.take_over(true);
  for (const fs::path& file : made) host.info("made " + (shown / file.lexically_relative(home.work())).string());
  host.info(fmt::format("{} of {} cases finished; results in {}", finished, plan.cases.size(), shown.string()));
  if (!others.empty()) host.info("not finished:\n" + others.substr(0, others.size() - 1));
  return others.empty();
}

}  // namespace

StudyEnd run_study(const StudyRequest& a, const Sweep& sweep, const SweepPlan& plan, Host& host) {
  const fs::path folder = study_folder(a, sweep);
  // The cases' folders are closed one by one, so that they can also be run by a workflow manager.
  ResultsFolder home(folder, FolderRules{true, "study", {"cases.csv", "results.csv", "results.json"}, "cases"}, host);
  std::map<std::string, std::string> crashes;
  if (!a.collect) {
    const std::vector<const PlannedCase*> open = to_run(plan, home.path(), a.overwrite, host);
    host.info(fmt::format("study `{}`: {} cases, {} to run", sweep.study().study.name, plan.cases.size(), open.size()));
    crashes = run_open(a, open, home, host);
    if (host.cancelled()) {
      host.info(fmt::format(
          "stopped on request; the same command goes on where it stopped, --collect gathers what there is in {}",
          folder.string()));
      return StudyEnd::stopped;
    }
  }
  return gather(sweep, plan, home, folder, crashes, host) ? StudyEnd::finished : StudyEnd::some_not;
}

}  // namespace breccia
