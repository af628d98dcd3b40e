// SPDX-License-Identifier: BSD-3-Clause
/// The folder of one case, and what it tells of the case.
#pragma once

#include "breccia/services.hpp"
#include "run/sweep_cases.hpp"

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
  std::string error;  ///< of a failed case, whole
};

std::filesystem::path case_folder(const std::filesystem::path& results, const SweepCase& c);

/// Reads case.json. Only a case whose inputs have that hash is finished or failed.
CaseRecord read_case(const std::filesystem::path& folder, const std::string& hash);

/// The folder of a case, made if need be and closed to other processes until this object goes.
class CaseFolder {
 public:
  /// Waits a little for a process that is about to end. UserError when the case is being run elsewhere.
  CaseFolder(const std::filesystem::path& folder, Json about, Host& host);
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder();

  /// Removes what an earlier run left; from here on case.json says how the case stands (when the process is killed it
  /// goes on saying `running`). UserError for a folder that holds anything but a case.
  void begin();
  void finished() { write("finished"); }
  void failed(const std::string& error) { write("failed", error); }
  void interrupted() { write("interrupted"); }

 private:
  void write(const std::string& status, const std::string& error = "");
  std::filesystem::path folder_;
  Json about_;
  int lock_ = -1;
};

/// What case.json says of a case besides how it stands.
Json about_case(const Sweep& sweep, const SweepCase& c, const ResolvedCase& resolved);

/// Marks a case as failed whose process has died.
void record_crash(const std::filesystem::path& folder, const std::string& hash, const std::string& error);

/// The standard streams of a case that is run as a process of its own, within its folder.
constexpr const char* case_log = "output.log";

}  // namespace breccia
