// SPDX-License-Identifier: BSD-3-Clause
/// Measures a finished packing.
#pragma once

#include "config.hpp"
#include "neighbours.hpp"

namespace breccia::labra_onate {

struct Quality {
  double porosity = 0;                                                           // overlaps counted twice
  double radius_mean = 0, radius_deviation = 0, radius_min = 0, radius_max = 0;  // [m]
  double neighbours = 0;                                     ///< mean number per particle in the neighbour set
  double tolerance = 0;                                      ///< widest relative gap in the set
  double mean_overlap = 0, max_overlap = 0;                  ///< relative to the sum of the radii, over the set
  double mean_gap = 0, max_gap = 0;                          ///< likewise
  double misfit = 0;                                         ///< root mean square of (d - s)/s over the set
  double size_correlation = 0;                               ///< of the radii of neighbours
  Vec3 fabric = Vec3::Zero();                                ///< diagonal of <n (x) n> over the set
  std::size_t at_wall = 0;                                   ///< particles near enough to a wall to be drawn to it
  double tangent = 0;                                        ///< share of them that touch it within 1e-3 r
  std::array<std::size_t, Container::max_walls> touching{};  ///< per wall, within 1e-3 of the radius
};

Quality measure(const Spheres& s, const Container& box, const NeighbourSet& set);

/// Quality beside what was asked for.
std::vector<AskedGot> report(const Quality& q, const Config& c, const RadiusLaw& law, double factor, double neighbours,
                             const Container& box, std::size_t particles);

}  // namespace breccia::labra_onate
