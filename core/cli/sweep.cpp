// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <thread>

#include "cli/console.hpp"
#include "cli/renderer_settings.hpp"
#include "cli/verbs.hpp"
#include "results/results_folder.hpp"
#include "run/load_workflow.hpp"
#include "run/packing_cache.hpp"
#include "run/runner.hpp"
#include "study/jobs.hpp"
#include "study/study_results.hpp"

namespace breccia::cli {
namespace {

namespace fs = std::filesystem;

fs::path results_folder(const SweepArguments& a, const Sweep& sweep) {
  return a.output.empty() ? fs::path("results") / sweep.study().study.name : a.output;
}

UserError changed(const std::string& which) {
  return UserError(which +
                   " of other inputs: the study or a workflow has changed since. Nothing was run. "
                   "Choose another folder with --output, or have them run again with --overwrite");
}

/// A case by itself goes into a new folder or one of a study. (The whole study looks after its folder itself.)
void check_is_study(const fs::path& folder) {
  std::error_code unknown;
  if (!fs::exists(folder, unknown)) return;
  if (!fs::is_directory(folder, unknown))
    throw UserError("cannot write results to " + folder.string() + ": it is a file");
  if (fs::is_empty(folder, unknown)) return;
  for (const char* mark : {"cases", "breccia.json", ".breccia.lock"})
    if (fs::exists(folder / mark, unknown)) return;
  throw UserError("the folder " + folder.string() +
                  " holds files but no cases of a study: choose another with --output");
}

int run_one(const SweepArguments& a, const Sweep& sweep) {
  const SweepCase& c = sweep.find(a.one);
  check_is_study(results_folder(a, sweep));
  const fs::path folder = case_folder(results_folder(a, sweep), c);
  const ResolvedCase resolved = sweep.resolve(c);
  if (!a.expect.empty() && a.expect != resolved.hash)
    throw UserError("the study or its workflow was changed while it ran");
  Console console(a.threads);
  const auto has_finished = [&] {
    const CaseRecord before = read_case(folder, resolved.hash, console);
    if (before.others_there && !a.overwrite) throw changed("the finished results in " + folder.string() + " are");
    if (before.state == CaseState::finished)
      console.info(fmt::format("case {} ({}) has finished before", c.number, c.folder));
    return before.state == CaseState::finished;
  };
  if (has_finished()) return ok;
  std::optional<ResumePoint> resume = resume_case(folder, resolved.hash, console);
  CaseFolder record(folder, about_case(sweep, c, resolved), a.parent > 0, resume.has_value(), console);
  if (has_finished()) return ok;  // while this process waited
  record.begin();
  try {
    console.log_to(record.work() / "run.log", resume.has_value());
    console.info(fmt::format("breccia {}: case {} of study `{}` into {}", BRECCIA_VERSION, c.number,
                             sweep.study().study.name, folder.string()));
    const RunOutcome outcome =
        run_workflow(resolved.loaded, sweep.registry(c),
                     {record.work(), default_cache_folder(), [&](bool stopped) { return record.whole(stopped); },
                      resume ? &*resume : nullptr},
                     console);
    console.clear_bar();
    if (!outcome.failure.empty()) {
      record.failed(outcome.failure);
      return failure;
    }
    outcome.interrupted ? record.interrupted() : record.finished();
    console.info(outcome.interrupted ? "stopped on request" : "finished");
    return outcome.interrupted ? interrupted : ok;
  } catch (const Cancelled&) {
    record.interrupted();
    throw;
  } catch (const std::exception& e) {
    console.clear_bar();
    console.log_only(std::string("ended: ") + e.what());
    console.info(e.what());
    record.failed(e.what());
    return failure;
  }
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

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
    throw changed(fmt::format("{} finished case{} in {} ({}{}) {}", stale.size(), stale.size() == 1 ? "" : "s",
                              folder.string(), stale[0], stale.size() == 1 ? "" : ", ...",
                              stale.size() == 1 ? "is" : "are"));
  return open;
}

class LocalRun {
 public:
  /// `logs`: for the standard streams of the cases' processes.
  LocalRun(const SweepArguments& a, const fs::path& folder, const fs::path& logs, Console& console)
      : a_(a), folder_(folder), logs_(logs), console_(console) {}

  /// By the folder of the case: why it failed that could not say so itself.
  const std::map<std::string, std::string>& crashes() const { return crashes_; }

  void run(const std::vector<const PlannedCase*>& open) {
    std::vector<SweepJob> jobs;
    for (const PlannedCase* c : open) {
      SweepJob job{{"sweep", a_.study.string(), "--case", std::to_string(c->the.number), "--output", folder_.string(),
                    "--threads", std::to_string(a_.threads), "--expect", c->hash, "--parent", std::to_string(getpid())},
                   logs_ / (c->the.folder + ".log")};
      if (a_.overwrite) job.arguments.push_back("--overwrite");
      jobs.push_back(std::move(job));
    }
    const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
    const int at_once = a_.jobs > 0 ? a_.jobs : std::max(1, cores / a_.threads);
    run_jobs(
        jobs, at_once, [&] { return console_.cancelled(); },
        [&](std::size_t k, const JobEnd& end) { ended(*open[k], jobs[k].log, end, jobs.size()); });
  }

 private:
  void ended(const PlannedCase& c, const fs::path& log, const JobEnd& end, std::size_t count) {
    const fs::path place = case_folder(folder_, c.the);
    CaseRecord now = read_case(place, c.hash, console_);
    if (now.state != CaseState::finished && now.state != CaseState::failed && !console_.cancelled()) {
      // It could not say so itself.
      const std::string said = last_line(log);
      const std::string how =
          end.signal ? fmt::format("the process was ended by signal {} ({})", end.signal, strsignal(end.signal))
                     : fmt::format("the process ended with code {}", end.code);
      now = {CaseState::failed,
             end.signal || said.empty() ? how + (said.empty() ? "" : "; its last words: " + said) : said};
      crashes_[c.the.folder] = now.error;
      try {
        record_crash(place, c.hash, now.error, console_);
      } catch (const UserError& e) { console_.warn(e.what()); }
    }
    std::error_code ignored;
    if (now.state == CaseState::finished) fs::remove(log, ignored);  // run.log has the same
    console_.info(fmt::format("[{}/{}] {}: {}", ++done_, count, c.the.folder,
                              now.state == CaseState::failed ? "failed: " + now.error.substr(0, now.error.find('\n'))
                                                             : state_text(now.state)));
  }

  const SweepArguments& a_;
  const fs::path folder_, logs_;
  Console& console_;
  std::size_t done_ = 0;
  std::map<std::string, std::string> crashes_;
};

/// None when the study asks for none, or names no renderer and this installation has no pictures.
std::optional<PluginChoice> renderer_of(const Study& study, Host& host) {
  if (study.charts.empty()) return {};
  if (study.renderer) return study.renderer;
  const Registry registry;
  const std::vector<std::string> names = registry.names("renderer");
  if (std::find(names.begin(), names.end(), "pictures") != names.end())
    return renderer_settings("pictures", {}, registry);
  host.warn("no charts: the renderer `pictures` is not installed");
  return {};
}

/// Returns whether all cases have finished. `shown`: the folder as the user wrote it.
bool gather(const Sweep& sweep, const SweepPlan& plan, ResultsFolder& home, const fs::path& shown,
            const std::map<std::string, std::string>& crashes, Console& console) {
  std::vector<CaseResult> results = read_results(plan, home.path(), console);
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
      write_results(sweep, plan, table, renderer_of(sweep.study().study, console), home.work(), console);
  home.take_over(true);
  for (const fs::path& file : made) console.info("made " + (shown / file.lexically_relative(home.work())).string());
  console.info(fmt::format("{} of {} cases finished; results in {}", finished, plan.cases.size(), shown.string()));
  if (!others.empty()) console.info("not finished:\n" + others.substr(0, others.size() - 1));
  return others.empty();
}

}  // namespace

int sweep(const SweepArguments& a) {
  if (a.parent > 0) end_with(a.parent);
  const Sweep sweep(a.study);
  if (!a.one.empty()) return run_one(a, sweep);
  const SweepPlan planned = plan(sweep);
  if (a.cases) {
    fmt::print("{}", cases_csv(sweep, planned));
    return ok;
  }
  const fs::path folder = results_folder(a, sweep);
  Console console(1);
  // The cases' folders are closed one by one, so that they can also be run by a workflow manager.
  ResultsFolder home(folder, FolderRules{true, "study", {"cases.csv", "results.csv"}, "cases"}, console);
  LocalRun local(a, home.path(), home.work() / "logs", console);
  if (!a.collect) {
    const std::vector<const PlannedCase*> open = to_run(planned, home.path(), a.overwrite, console);
    console.info(
        fmt::format("study `{}`: {} cases, {} to run", sweep.study().study.name, planned.cases.size(), open.size()));
    local.run(open);
    if (console.cancelled()) {
      console.info(fmt::format(
          "stopped on request; the same command goes on where it stopped, --collect gathers what there is in {}",
          folder.string()));
      return interrupted;
    }
  }
  return gather(sweep, planned, home, folder, local.crashes(), console) ? ok : failure;
}

}  // namespace breccia::cli
