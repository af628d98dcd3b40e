// SPDX-License-Identifier: BSD-3-Clause
/// What is almost surely a mistake in the input, though it can be computed.
#pragma once

#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// Looks at the bonded specimen before the first step and warns of: particles with more volume than the specimen
/// (diameters read as radii), deep overlaps, bonds across wide gaps, particles without a bond, and such particles away
/// from the rest, by which the specimen would be measured.
void check_specimen(const SimulationView& view, double porosity, Host& host);

}  // namespace breccia
