// SPDX-License-Identifier: BSD-3-Clause
/// Whether a cell joins to its copies as it holds together within.
#pragma once

#include <array>
#include <string>

#include "breccia/packing.hpp"

namespace breccia::replicated_cell {

/// What is wrong with the cell at its boundary across the directions `used`; empty when nothing is. `space` is that of
/// the cell, whose centres are as they were read: contacts across the boundary are those between a particle and an
/// image of another, or of itself.
///
/// Nothing marks the boundary of a periodic packing. A plane across direction k that is put anywhere cuts
/// sum |b_k| / L_k contacts on average (b: branch vectors, L: period), and an overlap among those that it cuts is seen
/// with the weight |b_k|. At the boundary, where what is not periodic shows, both are compared with what is got.
std::string fault_at_seams(const PackedParticles& cell, const Space& space, const std::array<bool, 3>& used);

}  // namespace breccia::replicated_cell
