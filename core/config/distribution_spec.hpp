// SPDX-License-Identifier: BSD-3-Clause
/// How a parameter that scatters from bond to bond is written: the one declaration.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

/// The members that a distribution of this parameter has, a group. Its mean has the parameter's unit and range.
ParamSpec distribution_spec(const ParamSpec& parameter);

/// What ranges cannot say of one.
Issues check_distribution(const Json& distribution);

}  // namespace breccia
