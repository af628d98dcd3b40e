// SPDX-License-Identifier: BSD-3-Clause
/// What the workflow says about a packing, and what follows from it before any sphere is placed.
#pragma once

#include "breccia/packing.hpp"
#include "container.hpp"
#include "radii.hpp"

namespace breccia::labra_onate {

enum class Shape { cylinder, box };

struct ContainerConfig {
  Shape shape = Shape::cylinder;
  std::optional<double> diameter, height;    // [m]
  std::optional<std::vector<double>> size;   // [m]
  static void describe(Schema<ContainerConfig>& s);
};

struct RadiusConfig {
  Distribution distribution = Distribution::normal;
  std::optional<double> mean, standard_deviation, min, max;  // [m]
  static void describe(Schema<RadiusConfig>& s);
};

struct Config {
  ContainerConfig container;
  RadiusConfig radius;
  std::optional<long> particles;
  std::optional<double> porosity, neighbours_per_particle;
  long max_iterations = 0;
  double tolerance = 0;
};

void describe(Schema<Config>& s);

/// UserError when the container does not suit the dimension.
Container make_container(const ContainerConfig& c, int dimension);

/// Fills in what may be left out; UserError when the values contradict each other.
RadiusLaw make_radius_law(const RadiusConfig& c);

/// The radii to pack and the factor they were multiplied with to meet the porosity.
struct Sizes {
  std::vector<double> radii;  ///< ascending [m]
  double factor = 1;
};

/// Meets the number of particles exactly and the porosity to rounding, whichever are asked for. Warns when that takes
/// more than 2 %, and when the porosity is outside what the method does well; UserError when it is out of reach.
Sizes choose_sizes(const Config& c, const RadiusLaw& law, const Container& box, Host& host);

/// Sum of the volumes (areas in two dimensions) of the spheres, overlaps counted twice [m3], [m2].
double solid_measure(const std::vector<double>& radii, int dimension);

}  // namespace breccia::labra_onate
