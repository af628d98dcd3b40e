// SPDX-License-Identifier: BSD-3-Clause
/// A packing and its materials, dealt out to the ranks of a job.
#pragma once

#include "engine/assembly.hpp"
#include "run/packing_cache.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

/// Each rank gets a piece of the packing, as many particles as the others or what it has made itself, and the materials
/// of these. All ranks call it together; alone, the packing stays as it is. Where materials are given out by shares of
/// the whole, the first rank does it and holds all particles meanwhile.
Materials deal_packing(PackingOutcome& packing, const Workflow& workflow, RankLink* link);

}  // namespace breccia
