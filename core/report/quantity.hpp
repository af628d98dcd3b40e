// SPDX-License-Identifier: BSD-3-Clause
/// Values of inputs as people read them.
#pragma once

#include <string>

#include "breccia/schema.hpp"
#include "results/shown_quantity.hpp"

namespace breccia::report {

std::string percent_text(double share, int digits = 3);

/// A value as resolved.yaml has it: "3e10 Pa" is 30 GPa; a name loses its underscores. A mapping with `distribution`
/// is told in words; other structures are empty.
std::string value_text(const Json& written);
bool is_quantity(const Json& written);  ///< a number, with a unit or without
/// The number of "3e10 Pa", in the unit that it has; NaN when it is none.
double number_of(const Json& written);

/// With a capital at its beginning.
std::string capital(std::string text);

}  // namespace breccia::report
