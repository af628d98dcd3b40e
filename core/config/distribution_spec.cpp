// SPDX-License-Identifier: BSD-3-Clause
#include "config/distribution_spec.hpp"

namespace breccia {

ParamSpec distribution_spec(const ParamSpec& parameter) {
  ParamSpec group;
  group.name = parameter.name;
  group.type = ParamType::group;
  const auto add = [&](const char* name, ParamType type, const std::string& unit, const char* doc) -> ParamSpec& {
    ParamSpec& p = group.members.emplace_back();
    p.name = name;
    p.type = type;
    p.unit = unit;
    p.doc = doc;
    p.required = false;
    return p;
  };
  ParamSpec& shape = add("distribution", ParamType::choice, "1", "its shape");
  shape.required = true;
  shape.choices = {{"normal", "by its mean and deviation"},
                   {"lognormal", "the logarithm is normal; mean and deviation are those of the value itself"},
                   {"weibull", "of two parameters, by its mean and modulus: the weakest of many follow it, too"},
                   {"uniform", "evenly, by its mean and deviation"}};
  ParamSpec& mean = add("mean", ParamType::quantity, parameter.unit, "before it is truncated");
  mean.required = true;
  mean.lower = parameter.lower;
  mean.upper = parameter.upper;
  mean.example = parameter.example;
  add("modulus", ParamType::quantity, "1", "Weibull's m; small: wide").lower = Bound{0.1, true};
  add("standard_deviation", ParamType::quantity, parameter.unit, "of a shape other than weibull").lower =
      Bound{0, false};
  add("coefficient_of_variation", ParamType::quantity, "1", "standard deviation over mean").lower = Bound{0, false};
  add("min", ParamType::quantity, parameter.unit, "truncated there; default: where the parameter's range ends");
  add("max", ParamType::quantity, parameter.unit, "truncated there");
  for (const char* limit : {"min", "max"})
    for (ParamSpec& p : group.members)
      if (p.name == limit) p.lower = parameter.lower, p.upper = parameter.upper;
  group.exactly_one_of.push_back({"modulus", "standard_deviation", "coefficient_of_variation"});
  return group;
}

Issues check_distribution(const Json& d) {
  Issues issues;
  const bool weibull = d.at("distribution") == "weibull";
  if (weibull && !d.contains("modulus"))
    issues.push_back({"distribution", "a weibull distribution goes by its `modulus`"});
  if (!weibull && d.contains("modulus"))
    issues.push_back({"modulus", "only a weibull distribution has one; give `coefficient_of_variation`"});
  const double mean = d.at("mean");
  if (!(mean > 0)) issues.push_back({"mean", "of something that scatters must be above zero"});
  if (d.contains("min") && d.contains("max") && !(d.at("min") < d.at("max")))
    issues.push_back({"max", "must be above `min`"});
  if (d.contains("min") && d.at("min") > mean) issues.push_back({"min", "must not be above the mean"});
  if (d.contains("max") && d.at("max") < mean) issues.push_back({"max", "must not be below the mean"});
  return issues;
}

}  // namespace breccia
