// SPDX-License-Identifier: BSD-3-Clause
/// How a parameter that scatters from bond to bond is written: the one declaration.
#pragma once

#include "breccia/schema.hpp"

namespace breccia {

enum class DistributionShape { normal, lognormal, weibull, uniform };

/// In a workflow: `tensile_strength: {mean: 40 MPa, distribution: weibull, modulus: 8}`. What has a unit has that of
/// the parameter.
struct DistributionConfig {
  DistributionShape shape;
  double mean;
  std::optional<double> modulus, standard_deviation, coefficient_of_variation, min, max;
  static void describe(Schema<DistributionConfig>& s);
};

/// The members that a distribution of this parameter has, a group. Its mean has the parameter's unit and range.
ParamSpec distribution_spec(const ParamSpec& parameter);

/// What ranges cannot say of one.
Issues check_distribution(const Json& distribution);

DistributionConfig load_distribution(const Json& distribution);

}  // namespace breccia
