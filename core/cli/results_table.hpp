// SPDX-License-Identifier: BSD-3-Clause
/// What the terminal shows of a run that has ended.
#pragma once

#include <string>

#include "breccia/schema.hpp"

namespace breccia::cli {

/// The results of a summary, a line each in units to read: moduli, strengths, cracks, energy error, all that the
/// workflow has a reference for, with that and the distance from it; and how many warnings there were.
std::string results_table(const Json& summary);

/// The same on the terminal.
void print_results(const Json& summary);

}  // namespace breccia::cli
