// SPDX-License-Identifier: BSD-3-Clause
/// A run with the folder of its results around it.
#pragma once

#include "run/run_request.hpp"
#include "run/terminal.hpp"

namespace breccia {

struct RunInFolder {
  RunOutcome outcome;
  std::string place;  ///< where the results are, as a message says it
  std::string kept;   ///< of a run that ended before its time: what is left of it, and how it goes on; may be empty
};

/// Of the workflow's values, all that the request sets.
std::vector<std::string> all_overrides(const RunRequest& request);

/// Runs what is asked for, into results/<name of the workflow> or the folder that the request names. What is thrown
/// tells, where files stay, what they are.
RunInFolder run_to_results(const RunRequest& request, Registry& registry, Terminal& terminal);

}  // namespace breccia
