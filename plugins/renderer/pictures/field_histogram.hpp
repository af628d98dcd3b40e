// SPDX-License-Identifier: BSD-3-Clause
/// How the values of a particle or bond field are distributed.
#pragma once

#include <optional>

#include "chart.hpp"
#include "results.hpp"

namespace breccia::pictures {

/// A bar for each of `bins` equal intervals between the least and the largest value, its height the share of the
/// values. UserError when there is nothing to draw.
Chart field_histogram(const Values& values, std::optional<long> bins);

}  // namespace breccia::pictures
