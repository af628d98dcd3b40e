// SPDX-License-Identifier: BSD-3-Clause
/// The best point of the cube by a score that is cheap for many points at a time.
#pragma once

#include <functional>
#include <openturns/Point.hxx>
#include <openturns/Sample.hxx>

namespace kriging {

/// Scores of many points; the higher the better.
using Score = std::function<OT::Point(const OT::Sample&)>;

/// Points that fill the cube evenly, from the `first` of their sequence on, shifted by what belongs to `seed`.
/// Source: Sobol' (1967); Cranley, Patterson (1976), SIAM J. Numer. Anal. 13, 904-914: the shift.
OT::Sample filling(OT::UnsignedInteger dimension, OT::UnsignedInteger first, OT::UnsignedInteger count,
                   OT::UnsignedInteger seed);

/// Filling points and the `known` ones, then nearer and nearer to the best of them. OpenTURNS' random generator is
/// used as it stands.
OT::Point best_point(const Score& score, const OT::Sample& known, OT::UnsignedInteger seed);

}  // namespace kriging
