// SPDX-License-Identifier: BSD-3-Clause
/// Exact sums over all ranks.
#pragma once

#include <span>
#include <vector>

#include "breccia/exact_sum.hpp"

namespace breccia {

class RankLink;

/// The values of several sums; of a specimen in parts, whose own part each rank has added, those of the whole. `link`:
/// null where there is but one part. All ranks ask together.
std::vector<double> totals(std::span<ExactSum> sums, RankLink* link);

}  // namespace breccia
