// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "run/packing_cache.hpp"
#include "run/runner.hpp"
#include "study/study_run.hpp"

namespace breccia {

namespace fs = std::filesystem;

fs::path study_folder(const StudyRequest& a, const Sweep& sweep) {
  return a.output.empty() ? fs::path("results") / sweep.study().study.name : a.output;
}

UserError other_inputs(const std::string& which) {
  return UserError(which +
                   " of other inputs: the study or a workflow has changed since. Nothing was run. "
                   "Choose another folder with --output, or have them run again with --overwrite");
}

namespace {

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

}  // namespace

CaseToRun case_to_run(const StudyRequest& a, const Sweep& sweep) {
  const SweepCase& c = sweep.find(a.one);
  check_is_study(study_folder(a, sweep));
  CaseToRun ready{c, case_folder(study_folder(a, sweep), c), sweep.resolve(c)};
  if (!a.expect.empty() && a.expect != ready.resolved.hash)
    throw UserError("the study or its workflow was changed while it ran");
  return ready;
}

StudyEnd run_case(const StudyRequest& a, const Sweep& sweep, const CaseToRun& c, Terminal& terminal) {
  const auto has_finished = [&] {
    const CaseRecord before = read_case(c.folder, c.resolved.hash, terminal);
    if (before.others_there && !a.overwrite)
      throw other_inputs("the finished results in " + c.folder.string() + " are");
    if (before.state == CaseState::finished)
      terminal.info(fmt::format("case {} ({}) has finished before", c.the.number, c.the.folder));
    return before.state == CaseState::finished;
  };
  if (has_finished()) return StudyEnd::finished;
  std::optional<ResumePoint> resume = resume_case(c.folder, c.resolved.hash, terminal);
  CaseFolder record(c.folder, about_case(sweep, c.the, c.resolved), a.parent > 0, resume.has_value(), terminal);
  if (has_finished()) return StudyEnd::finished;  // while this process waited
  record.begin();
  try {
    terminal.log_to(record.work() / "run.log", resume.has_value());
    terminal.info(fmt::format("breccia {}: case {} of study `{}` into {}", BRECCIA_VERSION, c.the.number,
                              sweep.study().study.name, c.folder.string()));
    const RunOutcome outcome =
        run_workflow(c.resolved.loaded, sweep.registry(c.the),
                     {record.work(), default_cache_folder(), [&](bool stopped) { return record.whole(stopped); },
                      resume ? &*resume : nullptr},
                     terminal);
    terminal.clear_bar();
    if (!outcome.failure.empty()) {
      record.failed(outcome.failure);
      return StudyEnd::some_not;
    }
    outcome.interrupted ? record.interrupted() : record.finished();
    terminal.info(outcome.interrupted ? "stopped on request" : "finished");
    return outcome.interrupted ? StudyEnd::stopped : StudyEnd::finished;
  } catch (const Cancelled&) {
    record.interrupted();
    throw;
  } catch (const std::exception& e) {
    terminal.clear_bar();
    terminal.log_only(std::string("ended: ") + e.what());
    terminal.info(e.what());
    record.failed(e.what());
    return StudyEnd::some_not;
  }
}

}  // namespace breccia
