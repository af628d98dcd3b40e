// SPDX-License-Identifier: BSD-3-Clause
#include "study/run_in_folder.hpp"

#include <fmt/format.h>

#include "run/packing_cache.hpp"
#include "run/runner.hpp"

namespace breccia {

UserError other_inputs(const std::string& which) {
  return UserError(which +
                   " of other inputs: the study or a workflow has changed since. Nothing was run. "
                   "Choose another folder with --output, or have them run again with --overwrite");
}

StudyEnd run_in_folder(const FolderRun& r, Terminal& terminal) {
  const auto has_finished = [&] {
    const CaseRecord before = read_case(r.folder, r.hash, terminal);
    if (before.others_there && !r.overwrite)
      throw other_inputs("the finished results in " + r.folder.string() + " are");
    if (before.state == CaseState::finished) terminal.info(r.named + " has finished before");
    return before.state == CaseState::finished;
  };
  if (has_finished()) return StudyEnd::finished;
  std::optional<ResumePoint> resume = resume_case(r.folder, r.hash, terminal);
  CaseFolder record(r.folder, r.about, r.wait, resume.has_value(), terminal);
  if (has_finished()) return StudyEnd::finished;  // while this process waited
  record.begin();
  try {
    terminal.log_to(record.work() / "run.log", resume.has_value());
    terminal.info(fmt::format("breccia {}: {} into {}", BRECCIA_VERSION, r.named, r.folder.string()));
    const RunOutcome outcome =
        run_workflow(r.loaded, r.registry,
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
