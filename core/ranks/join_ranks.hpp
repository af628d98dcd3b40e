// SPDX-License-Identifier: BSD-3-Clause
/// Whether this process is one of several that a launcher (mpirun, srun) has started for one run.
#pragma once

#include <memory>

#include "engine/rank_link.hpp"

namespace breccia {

/// The link to the others; null where there are none. What it needs of MPI and PETSc is a library of its own, which is
/// loaded here and only when there are others: the program itself starts as quickly as without. UserError when it is
/// not there or cannot be loaded.
std::unique_ptr<RankLink> join_ranks();

}  // namespace breccia
