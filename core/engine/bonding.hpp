// SPDX-License-Identifier: BSD-3-Clause
/// Which neighbours are glued together before loading.
#pragma once

#include <optional>

#include "model/state.hpp"

namespace breccia {

class Parts;

/// By which of its gaps a pair counts as near.
enum class GapMeasure {
  relative,  ///< distance/(r_i + r_j) - 1 [1]
  absolute   ///< distance - r_i - r_j [m]
};

/// A limit, or the coordination number that the limit is to give: one of the two.
struct BondingRule {
  GapMeasure measure = GapMeasure::relative;
  std::optional<double> limit;                ///< bond when the gap is at most this [1] or [m]
  std::optional<double> coordination_number;  ///< mean number of bonds per particle
};

struct BondingResult {
  GapMeasure measure = GapMeasure::relative;
  double limit = 0;                ///< used [1] or [m]
  double coordination_number = 0;  ///< 2 bonds / particles
  std::size_t bonds = 0;           ///< of the whole specimen
};

/// The pairs that the rule chooses, as intact bonds. UserError when the coordination number cannot be reached. `parts`:
/// of a specimen in parts, which then has copies of all that the own particles could be bonded to; else null.
BondingResult choose_bonds(State& state, const BondingRule& rule, Bonds& bonds, Parts* parts = nullptr);

}  // namespace breccia
