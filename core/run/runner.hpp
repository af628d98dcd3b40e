// SPDX-License-Identifier: BSD-3-Clause
/// Runs one workflow from its packing to its pictures.
#pragma once

#include <filesystem>
#include <functional>

#include "breccia/services.hpp"
#include "engine/rank_link.hpp"
#include "run/resume.hpp"
#include "workflow/read_workflow.hpp"

namespace breccia {

/// What the terminal shows while it runs.
struct RunStatus {
  double share_done = 0;  ///< estimate, 0 to 1
  std::uint64_t step = 0;
  double time = 0;  ///< [s]
  std::size_t bonds_broken = 0;
  std::string protocol_status;
};

class RunMonitor : public Host {
 public:
  virtual void status(const RunStatus& status) = 0;

 protected:
  ~RunMonitor() = default;
};

struct RunOptions {
  std::filesystem::path folder;         ///< exists; all files are written here
  std::filesystem::path packing_cache;  ///< empty: packings are not kept
  /// Called when all but the pictures is written, with whether the run was stopped on request; may take the files away
  /// to where they belong. Returns where they are now. Optional.
  std::function<std::filesystem::path(bool interrupted)> whole = {};
  ResumePoint* resume = nullptr;  ///< goes on from there; `folder` holds what the run had written
  bool accept_changed_plugins = false;
  /// Called before anything is written under way; throws what ends the run at once. Optional.
  std::function<void()> refuse_if_gone = {};
  RankLink* link = nullptr;  ///< of the ranks of a job only the first has files and something to say
};

struct RunOutcome {
  Json summary;
  bool interrupted = false;
  std::string failure = {};  ///< why the test ended before its time, with all files whole; empty when it did not
};

/// UserError for what the user can mend. Stops soon after `monitor.cancelled()`, with all files whole.
RunOutcome run_workflow(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options,
                        RunMonitor& monitor);

}  // namespace breccia
