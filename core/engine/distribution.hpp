// SPDX-License-Identifier: BSD-3-Clause
/// How a parameter scatters from bond to bond.
#pragma once

#include <optional>

namespace breccia {

struct Distribution {
  enum class Shape { normal, lognormal, weibull, uniform };
  Shape shape = Shape::normal;
  double mean = 0;                     ///< before it is truncated
  double deviation = 0;                ///< standard deviation; not of a Weibull distribution
  double modulus = 0;                  ///< of a Weibull distribution
  std::optional<double> lower, upper;  ///< truncated there: no value lies beyond

  /// The value below which a share `u` (0 to 1, neither of them) of what is drawn lies.
  double quantile(double u) const;
  /// Of the whole distribution, before it is truncated.
  double standard_deviation() const;
  /// Share of the distribution that lies between the two limits.
  double share_within() const;
};

}  // namespace breccia
