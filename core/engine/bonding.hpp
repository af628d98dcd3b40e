// SPDX-License-Identifier: BSD-3-Clause
/// Which neighbours are glued together before loading.
#pragma once

#include <optional>

#include "model/state.hpp"

namespace breccia {

/// Exactly one of the two.
struct BondingRule {
  std::optional<double> tolerance;            ///< bond when distance <= (1 + tolerance)(r_i + r_j)
  std::optional<double> coordination_number;  ///< the tolerance that gives this mean number of bonds per particle
};

struct BondingResult {
  double tolerance = 0;            ///< used
  double coordination_number = 0;  ///< 2 bonds / particles
};

/// Makes the bonds. UserError when the coordination number cannot be reached.
BondingResult make_bonds(State& state, const BondingRule& rule);

}  // namespace breccia
