// SPDX-License-Identifier: BSD-3-Clause
/// Mohr circles of several tests at failure and the Mohr-Coulomb line through them.
#pragma once

#include <optional>

#include "breccia/renderer.hpp"
#include "chart.hpp"

namespace breccia::pictures {

/// From the runs' summary.json, of those that have a strength (breccia/strength.hpp). None when these are not at two
/// confining pressures at least.
std::optional<Chart> strength_envelope_chart(const std::vector<ComparisonRequest::Run>& runs);

}  // namespace breccia::pictures
