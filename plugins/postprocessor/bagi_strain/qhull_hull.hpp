// SPDX-License-Identifier: BSD-3-Clause
/// The only place that knows Qhull.
#pragma once

#include <vector>

#include "breccia/types.hpp"

namespace breccia {

/// Facets of the convex hull that face downward along the last coordinate, cut into simplices: `dimension` point
/// numbers each, one after the other. `points`: `dimension` coordinates each, of magnitude one, with the origin in
/// their middle. UserError when Qhull gives up.
std::vector<Index> lower_hull(int dimension, std::vector<double> points);

}  // namespace breccia
