// SPDX-License-Identifier: BSD-3-Clause
#include "calibrate/calibration_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/calibration_files.hpp"
#include "calibrate/shown_values.hpp"
#include "plugin/guarded.hpp"
#include "results/results_folder.hpp"
#include "results/summary_keys.hpp"
#include "study/local_run.hpp"
#include "study/study_results.hpp"

namespace breccia {

namespace fs = std::filesystem;

namespace {

/// The course, gone with what the folders hold.
class Walk {
 public:
  Walk(const CalibrationTrials& trials, std::unique_ptr<Search> search, const fs::path& results)
      : evidence_(trials, results), search_(std::move(search)), course_(trials.calibration(), *search_) {}

  /// The next batch as it stands; false at the end.
  bool propose(Host& host) {
    batch_ = course_.next(host);
    for (const CoursePoint& p : batch_)
      for (const Trial& t : p.trials) records_.push_back(evidence_.look(t, host));
    return !batch_.empty();
  }
  /// Those of the batch that have not come to an end.
  std::vector<TrialRecord*> open() {
    std::vector<TrialRecord*> all;
    for (std::size_t k = first(); k < records_.size(); ++k)
      if (records_[k].is_open()) all.push_back(&records_[k]);
    return all;
  }
  void look_again(TrialRecord& r, Host& host) { r = evidence_.look(r.trial, host); }
  void take() {
    std::size_t k = first();
    for (CoursePoint& p : batch_)
      for (std::size_t j = 0; j < p.trials.size(); ++j) p.results.push_back(records_[k++].result);
    course_.add(std::move(batch_));
    batch_.clear();
  }
  std::span<TrialRecord> batch_records() { return std::span(records_).subspan(first()); }
  const std::vector<TrialRecord>& records() const { return records_; }
  const Evidence& evidence() const { return evidence_; }
  Course& course() { return course_; }

 private:
  std::size_t first() const {
    std::size_t runs = 0;
    for (const CoursePoint& p : batch_) runs += p.trials.size();
    return records_.size() - runs;
  }
  Evidence evidence_;
  std::unique_ptr<Search> search_;
  Course course_;
  std::vector<CoursePoint> batch_;
  std::vector<TrialRecord> records_;  ///< of all trials, in their order
};

class Run {
 public:
  Run(const CalibrationRequest& request, const CalibrationTrials& trials, const ResultsFolder& home, Walk& walk,
      Host& host)
      : a_(request), trials_(trials), home_(home), walk_(walk), host_(host) {}

  /// False when the user stopped it.
  bool batch() {
    std::vector<TrialRecord*> open = walk_.open();
    for (TrialRecord& r : walk_.batch_records())
      if (a_.retry_failed && r.state == CaseState::failed && !r.folder.empty() && tried_.insert(r.folder).second)
        open.push_back(&r);
    if (!open.empty()) {
      const std::size_t done = walk_.records().size() - walk_.batch_records().size();
      host_.info(fmt::format("{} of at most {} runs done; {} now", done, trials_.calibration().config.budget.runs,
                             open.size()));
      run(open);
    }
    if (host_.cancelled()) return false;
    for (TrialRecord* r : open)
      if (r->is_open())
        throw UserError("the run " + r->folder + " has come to no end; its log is in " + logs().string());
    return true;
  }

 private:
  fs::path logs() const { return home_.work() / "logs"; }

  void run(const std::vector<TrialRecord*>& open) {
    std::vector<LocalCase> all;
    for (const TrialRecord* r : open)
      all.push_back({r->folder,
                     walk_.evidence().folder(*r),
                     r->hash,
                     {"calibrate", a_.file.string(), "--trial", json_text(trials_.described(r->trial)), "--output",
                      home_.path().string(), "--threads", std::to_string(a_.threads), "--expect", r->hash, "--parent",
                      std::to_string(getpid())}});
    const int asked = a_.jobs > 0 ? a_.jobs : int(trials_.calibration().config.jobs.value_or(0));
    const auto crashes = run_locally(all, logs(), jobs_at_once(asked, a_.threads), host_);
    if (host_.cancelled()) return;
    for (TrialRecord* r : open) {
      walk_.look_again(*r, host_);
      if (const auto crash = crashes.find(r->folder); crash != crashes.end()) {
        r->state = CaseState::failed;
        r->result.error = crash->second;
      }
    }
  }

  const CalibrationRequest& a_;
  const CalibrationTrials& trials_;
  const ResultsFolder& home_;
  Walk& walk_;
  Host& host_;
  std::set<std::string> tried_;
};

/// "point 7: ucs 101 MPa, ts 8.2 MPa; 1.3 times the scatter away".
void tell(const LoadedCalibration& c, const CoursePoint& p, std::size_t number, Host& host) {
  std::string text;
  double sum = 0;
  for (std::size_t t = 0; t < c.targets.size(); ++t) {
    const TargetMeasure& m = c.targets[t].measure;
    const TargetStatistics s = statistics(p, t, m);
    text += (t ? ", " : "") + c.targets[t].name + " " + shown(m, m.back(s.mean), 3);
    sum += residual_of(m, s.mean) * residual_of(m, s.mean);
  }
  if (std::isfinite(sum))
    text += fmt::format("; {:.2g} times the scatter away", std::sqrt(sum / double(c.targets.size())));
  host.info(fmt::format("point {} ({}): {}", number, why_text(p.why), text));
}

}  // namespace

fs::path calibration_folder(const CalibrationRequest& a, const CalibrationTrials& trials) {
  return a.output.empty() ? fs::path("results") / trials.calibration().config.name : a.output;
}

StudyEnd run_calibration(const CalibrationRequest& a, const CalibrationTrials& trials, Host& host) {
  const LoadedCalibration& c = trials.calibration();
  const fs::path shown_folder = calibration_folder(a, trials);
  std::unique_ptr<Search> search = trials.search();  // before a folder is made
  // The runs' folders are closed one by one, so that they can also be run by a workflow manager.
  ResultsFolder home(shown_folder, FolderRules{true, "calibration", calibration_file_names(), "cases"}, host);
  Walk walk(trials, std::move(search), home.path());
  Run run(a, trials, home, walk, host);
  host.info(fmt::format("calibration `{}`: {} parameters, {} targets, {} workflows, at most {} runs", c.config.name,
                        c.parameters.size(), c.targets.size(), c.workflows.size(), plan_course(c).runs));
  bool whole = true;
  std::size_t told = 0;
  while (walk.propose(host)) {
    if (a.collect && !walk.open().empty()) {
      whole = false;
      break;
    }
    if (!a.collect && !run.batch()) {
      host.info(
          fmt::format("stopped on request; the same command goes on where it stopped, --collect tells what is "
                      "known so far in {}",
                      shown_folder.string()));
      return StudyEnd::stopped;
    }
    walk.take();
    const auto& points = walk.course().points();
    for (; told < points.size(); ++told) tell(c, points[told], told + 1, host);
  }
  const CalibrationOutcome outcome = outcome_of(trials, walk.course(), host);
  for (const fs::path& file :
       write_calibration(trials, walk.course(), walk.records(), outcome, whole, home.work(), shown_folder, host))
    host.info("made " + (shown_folder / file.lexically_relative(home.work())).string());
  home.take_over(true);
  for (const std::string& text : outcome.warnings) host.warn(text);
  for (std::size_t k = 0; k < outcome.best.size(); ++k)
    host.info(fmt::format(
        "{}: {}{}", c.parameters[k].name, shown(trials, k, outcome.best[k]),
        outcome.has_model
            ? fmt::format(" (90 %: {} to {})", shown(trials, k, outcome.parameters[k].low, digits_of_intervals),
                          shown(trials, k, outcome.parameters[k].high, digits_of_intervals))
            : ""));
  host.info(
      fmt::format("{} runs, {} of them failed; results in {}", outcome.runs, outcome.failed, shown_folder.string()));
  return whole && outcome.has_best ? StudyEnd::finished : StudyEnd::some_not;
}

std::string runs_so_far(const CalibrationRequest& a, const CalibrationTrials& trials, Host& host) {
  Walk walk(trials, trials.search(), fs::absolute(calibration_folder(a, trials)));
  while (walk.propose(host) && walk.open().empty()) walk.take();
  return runs_csv(trials, walk.course(), walk.records());
}

StudyEnd run_trial(const CalibrationRequest& a, const CalibrationTrials& trials, Terminal& terminal) {
  const fs::path results = fs::absolute(calibration_folder(a, trials));
  Trial trial;
  if (!a.trial.empty()) {
    trial = trials.from(Json::parse(a.trial, nullptr, false));
  } else {
    Walk walk(trials, trials.search(), results);
    while (walk.records().size() < a.one && walk.propose(terminal) && walk.open().empty()) walk.take();
    if (a.one > walk.records().size())
      throw UserError(
          fmt::format("there is no run {} yet: {} are known so far (see --cases)", a.one, walk.records().size()));
    trial = walk.records()[a.one - 1].trial;
  }
  const ResolvedTrial resolved = trials.resolve(trial);
  if (!a.expect.empty() && a.expect != resolved.hash)
    throw UserError("the calibration or a workflow was changed while it ran");
  Json about = trials.described(trial);
  about["calibration"] = trials.calibration().config.name;
  about["workflow_file"] = trials.calibration().workflows[trial.workflow].file;
  about["inputs_sha256"] = resolved.hash;
  return run_in_folder(
      {resolved.loaded, trials.registry(trial), results / "cases" / resolved.folder, resolved.hash, about,
       fmt::format("run {} of calibration `{}`", resolved.folder, trials.calibration().config.name), a.parent > 0,
       false, trials.calibration().run_time},
      terminal);
}

}  // namespace breccia
