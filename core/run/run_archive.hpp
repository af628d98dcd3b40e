// SPDX-License-Identifier: BSD-3-Clause
/// What of a run goes into a checkpoint, and comes back from one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/simulation.hpp"
#include "results/curve_table.hpp"
#include "run/checks.hpp"
#include "run/energy_check.hpp"
#include "run/frames.hpp"
#include "run/loading.hpp"
#include "run/resume.hpp"
#include "run/runner.hpp"
#include "run/warning_log.hpp"

namespace breccia {

class RunLog final : public WarningLog<RunMonitor> {
 public:
  using WarningLog::WarningLog;
  void status(const RunStatus& status) override { to_.status(status); }
};

/// All of a run that changes while it is under way.
struct RunParts {
  CheckpointAbout& about;
  RunLog& log;
  Simulation& simulation;
  Loading& loading;
  Protocol& protocol;
  PluginId protocol_id;
  std::vector<Listed<Postprocessor>>& posts;
  Frames& frames;
  CurveTable& curves;
  std::optional<EnergyCheck>& energy_check;
  LoadingChecks& loading_checks;
  bool first;  ///< of several ranks: who has curves and files
};

/// All that the steps to come depend on, both ways. Returns who does not say what belongs there.
std::vector<std::string> archive_run(Archive& archive, const RunParts& run);

/// Goes on with that run. UserError when the checkpoint is not of such a one.
void read_run(Archive& from, const RunParts& run);

/// Goes on with the test alone; `measured`: with what has been measured of it, too, and the warnings that belong to
/// that. Files begin anew.
void read_branch(Archive& from, const RunParts& run, bool measured);

}  // namespace breccia
