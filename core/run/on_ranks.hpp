// SPDX-License-Identifier: BSD-3-Clause
/// A run on several ranks: what the ranks behind the first do of it.
#pragma once

#include <optional>

#include "engine/rank_link.hpp"
#include "run/run_request.hpp"
#include "run/terminal.hpp"

namespace breccia {

/// The same run without a word and without a file: packing, bonds and the test are made on all ranks, from the same
/// workflow. `terminal` says whether the run is to stop, and how many threads there are.
RunOutcome run_beside(const RunRequest& request, Registry& registry, Terminal& terminal);

}  // namespace breccia
