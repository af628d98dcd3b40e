// SPDX-License-Identifier: BSD-3-Clause
#include "study/run_in_folder.hpp"

#include <fmt/format.h>

#include <chrono>

#include "run/packing_cache.hpp"
#include "run/runner.hpp"

namespace breccia {

namespace {

/// A terminal that asks the run to stop, as a user would, once its time is up.
class Timed final : public Terminal {
 public:
  Timed(Terminal& to, const RunTime& at_most) : to_(to), at_most_(at_most) {}
  void log_to(const std::filesystem::path& file, bool go_on) override { to_.log_to(file, go_on); }
  void log_only(const std::string& text) override { to_.log_only(text); }
  void clear_bar() override { to_.clear_bar(); }
  void status(const RunStatus& status) override { to_.status(status); }
  void info(std::string_view text) override { to_.info(text); }
  void warn(std::string_view text) override { to_.warn(text); }
  void progress(std::string_view what, double done) override { to_.progress(what, done); }
  int threads() const override { return to_.threads(); }
  bool cancelled() const override {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
    ended_ = ended_ || (limited_ && at_most_.seconds > 0 && taken.count() > at_most_.seconds);
    return ended_ || to_.cancelled();
  }
  /// What is whole is not thrown away for its pictures.
  void lift() { limited_ = false; }
  /// Whether the time ended the run; the user's own wish comes first.
  bool ended() const { return ended_ && !to_.cancelled(); }

 private:
  Terminal& to_;
  const RunTime& at_most_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool limited_ = true;
  mutable bool ended_ = false;
};

}  // namespace

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
  Timed timed(terminal, r.at_most);
  const auto out_of_time = [&] {
    const std::string text = "took longer than the " + r.at_most.text + " that a run may take";
    terminal.info(text);
    record.failed(text, true);
    return StudyEnd::some_not;
  };
  try {
    terminal.log_to(record.work() / "run.log", resume.has_value());
    terminal.info(fmt::format("breccia {}: {} into {}", BRECCIA_VERSION, r.named, r.folder.string()));
    const RunOutcome outcome = run_workflow(r.loaded, r.registry,
                                            {record.work(), default_cache_folder(),
                                             [&](bool stopped) {
                                               timed.lift();
                                               return record.whole(stopped);
                                             },
                                             resume ? &*resume : nullptr},
                                            timed);
    terminal.clear_bar();
    if (!outcome.failure.empty()) {
      record.failed(outcome.failure);
      return StudyEnd::some_not;
    }
    if (outcome.interrupted && timed.ended()) return out_of_time();
    outcome.interrupted ? record.interrupted() : record.finished();
    terminal.info(outcome.interrupted ? "stopped on request" : "finished");
    return outcome.interrupted ? StudyEnd::stopped : StudyEnd::finished;
  } catch (const Cancelled&) {
    if (timed.ended()) return out_of_time();
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
