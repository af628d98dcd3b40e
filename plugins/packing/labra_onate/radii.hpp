// SPDX-License-Identifier: BSD-3-Clause
/// Radii of a truncated distribution, met exactly: quantiles instead of random draws.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace breccia::labra_onate {

enum class Distribution { normal, lognormal, uniform };

/// What is asked of the radii [m]. Mean and standard deviation are those of the truncated distribution itself, not
/// of the one it is cut from.
struct RadiusLaw {
  Distribution distribution = Distribution::normal;
  double mean = 0, standard_deviation = 0, min = 0, max = 0;
};

/// The quantiles at (k + 1/2)/n, k = 0..n-1, ascending [m]. From 100 radii on, their mean and standard deviation are
/// those of the law to 1e-10; fewer are quantiles of the law for 100. UserError when no such distribution exists.
std::vector<double> quantile_radii(const RadiusLaw& law, std::size_t n);

}  // namespace breccia::labra_onate
