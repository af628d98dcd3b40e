// SPDX-License-Identifier: BSD-3-Clause
/// The folder of one case, and what it tells of the case.
#pragma once

#include <optional>

#include "breccia/services.hpp"
#include "results/results_folder.hpp"
#include "run/resume.hpp"
#include "study/cases.hpp"

namespace breccia {

enum class CaseState {
  absent,      ///< nobody has begun it
  unfinished,  ///< begun, then killed or interrupted; or being run just now
  failed,
  finished,
  other_inputs  ///< finished, but the study or a workflow has changed since
};

struct CaseRecord {
  CaseState state = CaseState::absent;
  std::string error;          ///< of a failed case, whole
  bool out_of_time = false;   ///< it failed because it took longer than it may
  bool others_there = false;  ///< finished results of other inputs are in the folder
};

std::filesystem::path case_folder(const std::filesystem::path& results, const SweepCase& c);

/// Reads case.json, that of an attempt that came to no end included. Only a case whose inputs have that hash is
/// finished or failed.
CaseRecord read_case(const std::filesystem::path& folder, const std::string& hash, Host& host);

/// Where a case that was stopped or killed goes on; empty when it begins anew: no checkpoint of these inputs.
std::optional<ResumePoint> resume_case(const std::filesystem::path& folder, const std::string& hash, Host& host);

/// The folder of a case: its results are made, kept and closed to other processes as those of any run; case.json is one
/// of them. Finished results are replaced by finished ones only.
class CaseFolder {
 public:
  /// FolderInUse when the case is being run elsewhere; `wait`: if that goes on for half a minute (a process may be
  /// about to end whose study was killed). `go_on`: with what the case has left. UserError for a folder that cannot be
  /// used.
  CaseFolder(const std::filesystem::path& folder, Json about, bool wait, bool go_on, Host& host);

  const std::filesystem::path& work() const { return results_->work(); }  ///< where files are to be written
  /// From here on case.json says how the case stands (when the process is killed it goes on saying `running`).
  void begin() { write("running", ""); }
  /// For `RunOptions::whole`.
  std::filesystem::path whole(bool stopped);
  void finished() { end("finished", ""); }
  void failed(const std::string& error, bool out_of_time = false) {
    if (out_of_time) about_["out_of_time"] = true;
    end("failed", error);
  }
  void interrupted() { end("interrupted", ""); }

 private:
  void end(const std::string& status, const std::string& error);
  void write(const std::string& status, const std::string& error);
  Json about_;
  std::optional<ResultsFolder> results_;
};

/// What case.json says of a case besides how it stands.
Json about_case(const Sweep& sweep, const SweepCase& c, const ResolvedCase& resolved);

/// Marks a case as failed whose process has died in the middle; nothing if it had written nothing.
void record_crash(const std::filesystem::path& folder, const std::string& hash, const std::string& error, Host& host);

constexpr const char* case_file = "case.json";

}  // namespace breccia
