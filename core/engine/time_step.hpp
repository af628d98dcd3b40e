// SPDX-License-Identifier: BSD-3-Clause
/// The largest stable time step.
#pragma once

#include "breccia/contact_law.hpp"
#include "model/state.hpp"

namespace breccia {

/// A bound from each particle's own 6x6 stiffness with its neighbours held (all pairs of the list and wall touches
/// counted as active): a spring's energy is at most twice that of its two ends moving alone, so the highest
/// frequency of the system satisfies omega^2 <= 2 max_i lambda_max(M_i^-1 K_ii), and the step is 2/omega [s].
/// Looks at the given particles only; infinite when none of them is held by anything stiff.
double critical_time_step(State& state, ContactLaw& law, const std::vector<Index>& particles);

}  // namespace breccia
