// SPDX-License-Identifier: BSD-3-Clause
#include "study/study_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <thread>

#include "plugin/drawing.hpp"
#include "results/results_folder.hpp"
#include "study/jobs.hpp"
#include "study/study_results.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

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
    throw other_inputs(fmt::format("{} finished case{} in {} ({}{}) {}", stale.size(), stale.size() == 1 ? "" : "s",
                                   folder.string(), stale[0], stale.size() == 1 ? "" : ", ...",
                                   stale.size() == 1 ? "is" : "are"));
  return open;
}

class LocalRun {
 public:
  /// `logs`: for the standard streams of the cases' processes.
  LocalRun(const StudyRequest& a, const fs::path& folder, const fs::path& logs, Host& host)
      : a_(a), folder_(folder), logs_(logs), host_(host) {}

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
        jobs, at_once, [&] { return host_.cancelled(); },
        [&](std::size_t k, const JobEnd& end) { ended(*open[k], jobs[k].log, end, jobs.size()); });
  }

 private:
  void ended(const PlannedCase& c, const fs::path& log, const JobEnd& end, std::size_t count) {
    const fs::path place = case_folder(folder_, c.the);
    CaseRecord now = read_case(place, c.hash, host_);
    if (now.state != CaseState::finished && now.state != CaseState::failed && !host_.cancelled()) {
      // It could not say so itself.
      const std::string said = last_line(log);
      const std::string how =
          end.signal ? fmt::format("the process was ended by signal {} ({})", end.signal, strsignal(end.signal))
                     : fmt::format("the process ended with code {}", end.code);
      now = {CaseState::failed,
             end.signal || said.empty() ? how + (said.empty() ? "" : "; its last words: " + said) : said};
      crashes_[c.the.folder] = now.error;
      try {
        record_crash(place, c.hash, now.error, host_);
      } catch (const UserError& e) { host_.warn(e.what()); }
    }
    std::error_code ignored;
    if (now.state == CaseState::finished) fs::remove(log, ignored);  // run.log has the same
    host_.info(fmt::format("[{}/{}] {}: {}", ++done_, count, c.the.folder,
                           now.state == CaseState::failed ? "failed: " + now.error.substr(0, now.error.find('\n'))
                                                          : state_text(now.state)));
  }

  const StudyRequest& a_;
  const fs::path folder_, logs_;
  Host& host_;
  std::size_t done_ = 0;
  std::map<std::string, std::string> crashes_;
};

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
  LocalRun local(a, home.path(), home.work() / "logs", host);
  if (!a.collect) {
    const std::vector<const PlannedCase*> open = to_run(plan, home.path(), a.overwrite, host);
    host.info(fmt::format("study `{}`: {} cases, {} to run", sweep.study().study.name, plan.cases.size(), open.size()));
    local.run(open);
    if (host.cancelled()) {
      host.info(fmt::format(
          "stopped on request; the same command goes on where it stopped, --collect gathers what there is in {}",
          folder.string()));
      return StudyEnd::stopped;
    }
  }
  return gather(sweep, plan, home, folder, local.crashes(), host) ? StudyEnd::finished : StudyEnd::some_not;
}

}  // namespace breccia
