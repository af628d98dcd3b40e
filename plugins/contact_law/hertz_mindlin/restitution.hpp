// SPDX-License-Identifier: BSD-3-Clause
/// The dashpot that makes a coefficient of restitution.
#pragma once

#include <cmath>
#include <numbers>

namespace breccia::hertz_mindlin {

constexpr double least_restitution = 0.01;  ///< below, the dashpot sets the time step alone

/// beta of a coefficient of restitution e, for a contact that parts when its force has fallen to zero.
///
/// With w = u^(5/4) in place of the overlap u and u^(1/4) dt in place of dt the impact is that of a linear spring with
/// beta times the critical damping. It ends when spring and dashpot cancel, not when u = 0: beta = cos(theta) and
/// e = exp(-2 theta cot theta); beyond the critical damping beta = cosh(eta) and e = exp(-2 eta coth eta). (With a
/// dashpot that may pull until u = 0, beta = -ln e/sqrt(ln^2 e + pi^2).)
inline double damping_ratio(double e) {
  const double wanted = -0.5 * std::log(e);
  const bool below_critical = wanted < 1;
  // theta cot theta falls from 1 to 0, eta coth eta rises from 1.
  double low = 0, high = below_critical ? 0.5 * std::numbers::pi : wanted;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high), cot = below_critical ? 1 / std::tan(middle) : 1 / std::tanh(middle);
    const bool too_large = middle * cot > wanted;
    (too_large == below_critical ? low : high) = middle;
  }
  return below_critical ? (wanted > 0 ? std::cos(high) : 0.0) : std::cosh(high);
}

}  // namespace breccia::hertz_mindlin
