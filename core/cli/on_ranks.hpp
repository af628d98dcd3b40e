// SPDX-License-Identifier: BSD-3-Clause
/// A verb on all ranks of a job.
#pragma once

#include <functional>

#include "engine/rank_link.hpp"

namespace breccia::cli {

/// Calls `verb` with the link to the other ranks, if a launcher has started any. What all ranks throw is said once, by
/// the first; what one throws by itself ends the job.
int on_ranks(const std::function<int(RankLink*)>& verb);

/// How many threads each has by default: the cores of the machine, or those that the launcher has bound the rank to,
/// dealt to the ranks that are there.
int threads_of_rank(RankLink& link, int cores);

}  // namespace breccia::cli
