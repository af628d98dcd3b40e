// SPDX-License-Identifier: BSD-3-Clause
#include "config/distribution_spec.hpp"

namespace breccia {

void DistributionConfig::describe(Schema<DistributionConfig>& s) {
  s.param("distribution", &DistributionConfig::shape)
      .choice("normal", DistributionShape::normal, "by its mean and deviation")
      .choice("lognormal", DistributionShape::lognormal,
              "the logarithm is normal; mean and deviation are those of the value itself")
      .choice("weibull", DistributionShape::weibull,
              "of two parameters, by its mean and modulus: the weakest of many follow it, too")
      .choice("uniform", DistributionShape::uniform, "evenly, by its mean and deviation")
      .doc("its shape");
  s.param("mean", &DistributionConfig::mean).doc("before it is truncated");
  s.param("modulus", &DistributionConfig::modulus).at_least(0.1).doc("Weibull's m; small: wide");
  s.param("standard_deviation", &DistributionConfig::standard_deviation).above(0).doc("of a shape other than weibull");
  s.param("coefficient_of_variation", &DistributionConfig::coefficient_of_variation)
      .above(0)
      .doc("standard deviation over mean");
  s.param("min", &DistributionConfig::min).doc("truncated there; default: where the parameter's range ends");
  s.param("max", &DistributionConfig::max).doc("truncated there");
  s.exactly_one_of({"modulus", "standard_deviation", "coefficient_of_variation"});
  s.check([](const DistributionConfig& c, Issues& issues) {
    const bool weibull = c.shape == DistributionShape::weibull;
    if (weibull && !c.modulus) issues.push_back({"distribution", "a weibull distribution goes by its `modulus`"});
    if (!weibull && c.modulus)
      issues.push_back({"modulus", "only a weibull distribution has one; give `coefficient_of_variation`"});
    if (!(c.mean > 0)) issues.push_back({"mean", "of something that scatters must be above zero"});
    if (c.min && c.max && !(*c.min < *c.max)) issues.push_back({"max", "must be above `min`"});
    if (c.min && *c.min > c.mean) issues.push_back({"min", "must not be above the mean"});
    if (c.max && *c.max < c.mean) issues.push_back({"max", "must not be below the mean"});
  });
}

namespace {

const Schema<DistributionConfig>& schema() {
  static const Schema<DistributionConfig> schema = [] {
    Schema<DistributionConfig> s;
    DistributionConfig::describe(s);
    return s;
  }();
  return schema;
}

}  // namespace

ParamSpec distribution_spec(const ParamSpec& parameter) {
  ParamSpec group = schema().documentation().root;
  group.name = parameter.name;
  for (ParamSpec& p : group.members) {
    const bool limit = p.name == "min" || p.name == "max", mean = p.name == "mean";
    if (mean || limit || p.name == "standard_deviation") p.unit = parameter.unit;
    if (mean || limit) {
      p.lower = parameter.lower;
      p.upper = parameter.upper;
    }
    if (mean) p.example = parameter.example;
  }
  return group;
}

Issues check_distribution(const Json& distribution) { return schema().check(distribution); }

DistributionConfig load_distribution(const Json& distribution) { return schema().load(distribution); }

}  // namespace breccia
