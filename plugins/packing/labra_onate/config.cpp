// SPDX-License-Identifier: BSD-3-Clause
#include "config.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::labra_onate {

void ContainerConfig::describe(Schema<ContainerConfig>& s) {
  s.param("shape", &ContainerConfig::shape)
      .choice("cylinder", Shape::cylinder, "axis z, centre of the base at the origin")
      .choice("box", Shape::box, "x and y centred, z from 0; in two dimensions x centred, y from 0")
      .doc("what the particles fill");
  s.param("diameter", &ContainerConfig::diameter).unit("m").above(0).example("23 mm").doc("of the cylinder");
  s.param("height", &ContainerConfig::height).unit("m").above(0).example("46 mm").doc("of the cylinder");
  s.param("size", &ContainerConfig::size).unit("m").items(2, 3).example("[50 mm, 50 mm, 100 mm]")
      .doc("of the box along x, y, z; the third is not needed in two dimensions");
}

void RadiusConfig::describe(Schema<RadiusConfig>& s) {
  s.param("distribution", &RadiusConfig::distribution)
      .choice("normal", Distribution::normal, "normal, cut at min and max")
      .choice("lognormal", Distribution::lognormal, "lognormal, cut at min and max")
      .choice("uniform", Distribution::uniform, "uniform, from min to max, or from its mean and standard_deviation")
      .doc("of the number of particles over their radius")
      .fallback("normal");
  s.param("mean", &RadiusConfig::mean).unit("m").above(0).example("0.676 mm")
      .doc("mean radius, of the distribution as cut");
  s.param("standard_deviation", &RadiusConfig::standard_deviation).unit("m").at_least(0).example("0.135 mm")
      .doc("of the radius, of the distribution as cut");
  s.param("min", &RadiusConfig::min).unit("m").above(0).example("0.312 mm")
      .doc("smallest radius; by default three standard deviations below the mean, or a tenth of the mean if larger");
  s.param("max", &RadiusConfig::max).unit("m").above(0).example("1.186 mm")
      .doc("largest radius; by default four standard deviations above the mean");
}

RadiusLaw make_radius_law(const RadiusConfig& c) {
  RadiusLaw law;
  law.distribution = c.distribution;
  if (law.distribution == Distribution::uniform && c.min && c.max) {
    law.min = *c.min;
    law.max = *c.max;
    law.mean = 0.5 * (law.min + law.max);
    law.standard_deviation = (law.max - law.min) / std::sqrt(12.0);
    if ((c.mean && std::abs(*c.mean / law.mean - 1) > 0.01) ||
        (c.standard_deviation && std::abs(*c.standard_deviation - law.standard_deviation) > 0.01 * law.mean))
      throw UserError("a uniform distribution follows from min and max alone, and the mean or standard_deviation given "
                      "beside them differs from theirs: leave mean and standard_deviation out");
  } else {
    if (!c.mean || !c.standard_deviation)
      throw UserError(law.distribution == Distribution::uniform
                          ? "a uniform distribution needs min and max, or mean and standard_deviation"
                          : "this distribution needs mean and standard_deviation");
    law.mean = *c.mean;
    law.standard_deviation = *c.standard_deviation;
    const double half = std::sqrt(3.0) * law.standard_deviation;
    const bool uniform = law.distribution == Distribution::uniform;
    const double low = uniform ? law.mean - half : std::max(law.mean - 3 * law.standard_deviation, 0.1 * law.mean);
    law.min = c.min.value_or(low);
    law.max = c.max.value_or(law.mean + (uniform ? half : 4 * law.standard_deviation));
    if (uniform && (c.min || c.max))
      throw UserError("a uniform distribution needs both min and max, or neither");
  }
  if (!(law.min > 0))
    throw UserError("this standard_deviation gives radii below zero: lower it");
  if (law.min > law.max) throw UserError("min is larger than max");
  if (law.mean < law.min || law.mean > law.max) throw UserError("the mean is not between min and max");
  quantile_radii(law, 100);  // is there such a distribution?
  return law;
}

Container make_container(const ContainerConfig& c, int dimension) {
  if (c.shape == Shape::cylinder) {
    if (dimension == 2)
      throw UserError("a cylinder cannot be packed in two dimensions: use a box with size: [width, height]");
    if (!c.diameter || !c.height || c.size)
      throw UserError("a cylinder is given by diameter and height, and by nothing else");
    return Container::cylinder(*c.diameter, *c.height);
  }
  if (!c.size || c.diameter || c.height) throw UserError("a box is given by size, and by nothing else");
  const std::vector<double>& size = *c.size;
  for (const double x : size)
    if (!(x > 0)) throw UserError("every entry of size must be above zero");
  if (dimension == 2) return Container::rectangle(size[0], size[1]);
  if (size.size() < 3) throw UserError("a box in three dimensions needs three entries in size: [x, y, z]");
  return Container::box(size[0], size[1], size[2]);
}

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
  s.param("particles", &Config::particles).at_least(1).at_most(50e6).example("10225")
      .doc("how many; with a porosity as well, all radii are multiplied by the factor that meets it. Without it, the "
           "number follows from the porosity");
  s.param("porosity", &Config::porosity).above(0).below(1).example("0.23")
      .doc("void fraction, overlaps counted twice. Without it, the porosity follows from the particles");
  s.param("radius", &Config::radius).doc("of the particles");
  s.param("neighbours_per_particle", &Config::neighbours_per_particle).above(0).at_most(14).example("11.8942")
      .doc("mean number of neighbours of a particle in the set of pairs that are drawn together; best near the mean "
           "number of bonds wanted. By default 12, in two dimensions 5");
  s.param("max_iterations", &Config::max_iterations).at_least(1).at_most(100000)
      .doc("largest number of steps in each of the three stages").fallback(200);
  s.param("tolerance", &Config::tolerance).above(0).below(1)
      .doc("a stage ends when three steps in a row each lower the sum of squares by less than this share")
      .fallback(1e-4);
  s.check([](const Config& c, Issues& issues) {
    if (!c.particles && !c.porosity) issues.push_back({"", "needs particles, or porosity, or both"});
    std::optional<Container> box;
    const bool flat = c.container.shape == Shape::box && c.container.size && c.container.size->size() == 2;
    try {
      box = make_container(c.container, flat ? 2 : 3);
    } catch (const UserError& e) {
      issues.push_back({"container", e.what()});
    }
    try {
      const RadiusLaw law = make_radius_law(c.radius);
      if (box && law.max > box->largest_radius())
        issues.push_back({"radius", "the largest radius does not fit into the container"});
    } catch (const UserError& e) {
      issues.push_back({"radius", e.what()});
    }
  });
}

}  // namespace breccia::labra_onate
