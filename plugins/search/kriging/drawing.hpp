// SPDX-License-Identifier: BSD-3-Clause
/// Points of the cube drawn from a density that is known but for a factor.
#pragma once

#include <functional>

#include "candidates.hpp"

namespace kriging {

/// A crowd is led from the whole cube to where the density is, which is made a little sharper each time: parameters
/// that nothing tells and those that are told to a hair are drawn alike, and those that can make up for each other.
/// OpenTURNS' random generator is used as it stands. `pause` is called now and then, and may throw.
/// Source: Del Moral, Doucet, Jasra (2006), J. R. Stat. Soc. B 68, 411-436.
OT::Sample drawn_from(const Score& log_density, OT::UnsignedInteger dimension, OT::UnsignedInteger count,
                      OT::UnsignedInteger seed, const std::function<void()>& pause);

}  // namespace kriging
