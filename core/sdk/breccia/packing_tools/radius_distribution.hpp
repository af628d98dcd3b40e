// SPDX-License-Identifier: BSD-3-Clause
/// Radii of a packing: what a workflow says of their distribution, and the radii themselves, as quantiles instead of
/// random draws, so that every seed gets the same ones and they have the moments asked for.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "breccia/packing_tools/radius_quantiles.hpp"
#include "breccia/schema.hpp"

namespace breccia {

struct SieveRow {
  double size = 0, passing = 0;  // [m], [1]
  static void describe(Schema<SieveRow>& s) {
    s.param("size", &SieveRow::size)
        .unit("m")
        .above(0)
        .example("2 mm")
        .doc("width of the mesh: diameter of the largest particle that passes");
    s.param("passing", &SieveRow::passing).at_least(0).at_most(1).example("45 %").doc("share of the mass that passes");
  }
};

struct RadiusConfig {
  DistributionFamily distribution = DistributionFamily::normal;
  std::optional<double> mean, standard_deviation, skewness, kurtosis, min, max;  // [m], [m], [1], [1], [m], [m]
  std::optional<std::vector<SieveRow>> sieves;

  static void describe(Schema<RadiusConfig>& s) {
    s.param("distribution", &RadiusConfig::distribution)
        .choice("normal", DistributionFamily::normal, "normal, cut at min and max")
        .choice("lognormal", DistributionFamily::lognormal, "lognormal, cut at min and max")
        .choice("weibull", DistributionFamily::weibull, "Weibull, cut at min and max")
        .choice("uniform", DistributionFamily::uniform,
                "uniform, from min to max, or from its mean and standard_deviation")
        .choice("moments", DistributionFamily::moments,
                "the distribution of largest entropy between min and max with this mean, standard_deviation and, where "
                "given, skewness and kurtosis: what is known, and nothing else")
        .choice("sieves", DistributionFamily::sieves, "a grading curve by mass, linear in the size between two sieves")
        .doc("of the number of particles over their radius")
        .fallback("normal");
    s.param("mean", &RadiusConfig::mean)
        .unit("m")
        .above(0)
        .example("0.676 mm")
        .doc("mean radius, of the distribution as cut");
    s.param("standard_deviation", &RadiusConfig::standard_deviation)
        .unit("m")
        .at_least(0)
        .example("0.135 mm")
        .doc("of the radius, of the distribution as cut");
    s.param("skewness", &RadiusConfig::skewness)
        .example("0.22")
        .doc("third central moment over the cube of the standard deviation; for `moments`");
    s.param("kurtosis", &RadiusConfig::kurtosis)
        .above(-2)
        .example("-0.06")
        .doc(
            "excess: fourth central moment over the fourth power of the standard deviation, less 3; for `moments`, "
            "together with skewness");
    s.param("min", &RadiusConfig::min)
        .unit("m")
        .above(0)
        .example("0.312 mm")
        .doc("smallest radius; by default three standard deviations below the mean, or a tenth of the mean if larger");
    s.param("max", &RadiusConfig::max)
        .unit("m")
        .above(0)
        .example("1.186 mm")
        .doc("largest radius; by default four standard deviations above the mean");
    s.param("sieves", &RadiusConfig::sieves)
        .items(2, 100)
        .example("[{size: 0.5 mm, passing: 0 %}, {size: 1 mm, passing: 40 %}, {size: 2 mm, passing: 100 %}]")
        .doc("for `sieves`: the grading curve from 0 to 100 % passing; sizes are diameters");
  }

  /// Fills in what may be left out; UserError when the values contradict each other.
  RadiusLaw law() const {
    if (distribution == DistributionFamily::sieves) return sieve_law();
    if (sieves) throw UserError("sieves belong to distribution: sieves");
    if ((skewness || kurtosis) && distribution != DistributionFamily::moments)
      throw UserError("skewness and kurtosis belong to distribution: moments");
    RadiusLaw law = distribution == DistributionFamily::uniform && min && max ? uniform_law() : law_of_moments();
    if (!(law.min > 0)) throw UserError("this standard_deviation gives radii below zero: lower it");
    if (law.min > law.max) throw UserError("min is larger than max");
    if (law.mean < law.min || law.mean > law.max) throw UserError("the mean is not between min and max");
    quantile_radii(law, 100);  // is there such a distribution?
    return law;
  }

 private:
  RadiusLaw uniform_law() const {
    RadiusLaw law;
    law.distribution = DistributionFamily::uniform;
    law.min = *min;
    law.max = *max;
    law.mean = 0.5 * (law.min + law.max);
    law.standard_deviation = (law.max - law.min) / std::sqrt(12.0);
    if ((mean && std::abs(*mean / law.mean - 1) > 0.01) ||
        (standard_deviation && std::abs(*standard_deviation - law.standard_deviation) > 0.01 * law.mean))
      throw UserError(
          "a uniform distribution follows from min and max alone, and the mean or standard_deviation given "
          "beside them differs from theirs: leave mean and standard_deviation out");
    return law;
  }

  RadiusLaw law_of_moments() const {
    const bool uniform = distribution == DistributionFamily::uniform;
    if (!mean || !standard_deviation)
      throw UserError(uniform ? "a uniform distribution needs min and max, or mean and standard_deviation"
                              : "this distribution needs mean and standard_deviation");
    if (uniform && (min || max)) throw UserError("a uniform distribution needs both min and max, or neither");
    if (kurtosis && !skewness) throw UserError("kurtosis needs skewness beside it");
    RadiusLaw law;
    law.distribution = distribution;
    law.mean = *mean;
    law.standard_deviation = *standard_deviation;
    law.skewness = skewness;
    law.kurtosis = kurtosis;
    const double half = std::sqrt(3.0) * law.standard_deviation;
    law.min = min.value_or(uniform ? law.mean - half : std::max(law.mean - 3 * law.standard_deviation, 0.1 * law.mean));
    law.max = max.value_or(law.mean + (uniform ? half : 4 * law.standard_deviation));
    return law;
  }

  RadiusLaw sieve_law() const {
    if (!sieves || mean || standard_deviation || skewness || kurtosis || min || max)
      throw UserError("distribution: sieves is given by sieves, and by nothing else");
    RadiusLaw law;
    law.distribution = DistributionFamily::sieves;
    for (const SieveRow& row : *sieves) {
      if (!law.grading.empty() &&
          (row.size <= 2 * law.grading.back().radius || row.passing < law.grading.back().passing))
        throw UserError("sieves: sizes must rise from row to row, and passing must not fall");
      law.grading.push_back({0.5 * row.size, row.passing});
    }
    if (law.grading.front().passing != 0 || law.grading.back().passing != 1)
      throw UserError("sieves: passing must begin with 0 % at the smallest size and end with 100 %");
    while (law.grading.size() > 2 && law.grading[1].passing == 0) law.grading.erase(law.grading.begin());
    while (law.grading.size() > 2 && law.grading[law.grading.size() - 2].passing == 1) law.grading.pop_back();
    law.min = law.grading.front().radius;
    law.max = law.grading.back().radius;
    const std::vector<double> sample = quantile_radii(law, 100000);
    law.mean = detail::mean_of(sample);
    law.standard_deviation = detail::deviation_of(sample);
    return law;
  }
};

}  // namespace breccia
