// SPDX-License-Identifier: BSD-3-Clause
/// Studies and their cases, run.
#pragma once

#include "study/run_in_folder.hpp"
#include "study/study_request.hpp"

namespace breccia {

/// The folder of the whole study.
std::filesystem::path study_folder(const StudyRequest& request, const Sweep& sweep);

/// One case, looked at before it is run.
struct CaseToRun {
  const SweepCase& the;
  std::filesystem::path folder;  ///< of the case
  ResolvedCase resolved;
};
/// UserError when there is no such case, when it is not in order, or has not the inputs that are expected.
CaseToRun case_to_run(const StudyRequest& request, const Sweep& sweep);

/// Runs it, or goes on where it stopped; nothing when it has finished before.
StudyEnd run_case(const StudyRequest& request, const Sweep& sweep, const CaseToRun& c, Terminal& terminal);

/// Runs the cases that have not finished, each by a process of this program, and gathers all.
StudyEnd run_study(const StudyRequest& request, const Sweep& sweep, const SweepPlan& plan, Host& host);

}  // namespace breccia
