// SPDX-License-Identifier: BSD-3-Clause
/// Whether neighbours are alike in size.
#pragma once

#include <cstdint>

#include "neighbours.hpp"

namespace breccia::labra_onate {

/// Pearson's correlation of the radii over the pairs of the set, both orders; 0 without pairs or spread.
double size_correlation(const Spheres& s, const NeighbourSet& set);

/// Swaps radii between spheres until neighbours have this correlation, or no swap brings it nearer. The places, the
/// neighbour set and the radii as a whole stay; spheres swap only with those of about as many neighbours, so that the
/// large ones keep more neighbours than the small ones.
void correlate_sizes(Spheres& s, const NeighbourSet& set, double wanted, std::uint64_t seed);

}  // namespace breccia::labra_onate
