// SPDX-License-Identifier: BSD-3-Clause
/// What the workflow says about a packing, and what follows from it before any sphere is placed.
#pragma once

#include "breccia/packing.hpp"
#include "breccia/packing_tools/fit.hpp"

namespace breccia::labra_onate {

struct Config {
  ContainerConfig container;
  RadiusConfig radius;
  std::optional<long> particles;
  std::optional<double> porosity, neighbours_per_particle, neighbour_size_correlation;
  long max_iterations = 0;
  double tolerance = 0;
};

void describe(Schema<Config>& s);

/// The radii to pack and the factor they were multiplied with to meet the porosity.
struct Sizes {
  std::vector<double> radii;  ///< ascending [m]
  double factor = 1;
};

/// Meets the number of particles exactly and the porosity to rounding, whichever are asked for. Warns when that takes
/// more than 2 %, and when the porosity is outside what the method does well; UserError when it is out of reach.
Sizes choose_sizes(const Config& c, const RadiusLaw& law, const Container& box, Host& host);

}  // namespace breccia::labra_onate
