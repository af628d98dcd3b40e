// SPDX-License-Identifier: BSD-3-Clause
#include "config.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::labra_onate {

void describe(Schema<Config>& s) {
  s.summary("Dense packing of spheres with given radii and porosity, by nonlinear least squares")
      .source("Labra & Oñate (2009), Commun. Numer. Meth. Engng 25, 837-849")
      .details(
          "Centres are moved, and radii exchanged, to minimise the sum over neighbouring pairs of "
          "((|x_i - x_j|^2 - s^2)/s^2)^2 with s = r_i + r_j: gaps close and overlaps spread evenly. Spheres next to a "
          "wall are tangent to it. The radii keep the distribution asked for exactly, and so does the porosity, "
          "1 - (sum of sphere volumes)/(container volume), with overlaps counted twice. Below about 36 % porosity "
          "overlaps cannot be avoided; bonds take the packing as it is for free of stress. The neighbour set holds all "
          "overlapping pairs and the pairs with the smallest relative gap, up to neighbours_per_particle. In two "
          "dimensions the particles are discs.");
  s.param("container", &Config::container).doc("the space to be filled");
  s.param("particles", &Config::particles)
      .at_least(1)
      .at_most(50e6)
      .example("10225")
      .doc(
          "how many; with a porosity as well, all radii are multiplied by the factor that meets it. Without it, the "
          "number follows from the porosity");
  s.param("porosity", &Config::porosity)
      .above(0)
      .below(1)
      .example("0.23")
      .doc("void fraction, overlaps counted twice. Without it, the porosity follows from the particles");
  s.param("radius", &Config::radius).doc("of the particles");
  s.param("neighbours_per_particle", &Config::neighbours_per_particle)
      .above(0)
      .at_most(14)
      .example("11.8942")
      .doc(
          "mean number of neighbours of a particle in the set of pairs that are drawn together; best near the mean "
          "number of bonds wanted. By default 12, in two dimensions 5");
  s.param("neighbour_size_correlation", &Config::neighbour_size_correlation)
      .above(-0.5)
      .below(0.9)
      .example("0.08")
      .doc(
          "correlation of the radii of neighbours that the optimisation starts from, as in packings whose sizes follow "
          "a mesh; without it, it comes out as it does, near zero. The optimisation lowers it somewhat: the report "
          "says by how much");
  s.param("max_iterations", &Config::max_iterations)
      .at_least(1)
      .at_most(100000)
      .doc("largest number of steps in each of the three stages")
      .fallback(200);
  s.param("tolerance", &Config::tolerance)
      .above(0)
      .below(1)
      .doc("a stage ends when three steps in a row each lower the sum of squares by less than this share")
      .fallback(1e-4);
  s.check([](const Config& c, Issues& issues) {
    if (!c.particles && !c.porosity) issues.push_back({"", "needs particles, or porosity, or both"});
    check_fit(c.container, c.radius, issues);
  });
}

}  // namespace breccia::labra_onate
