// SPDX-License-Identifier: BSD-3-Clause
#include "workflow/plausible.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "config/each_value.hpp"
#include "config/units.hpp"

namespace breccia {
namespace {

constexpr double any = std::numeric_limits<double>::infinity();

/// Of parameters with this unit whose names hold this word, in any section and of any plugin: their names are the
/// field's terms. Wide enough for foams and diamond; zero is a choice, not a slip.
struct PlausibleRange {
  const char *unit, *word, *of;
  double low, high;
};
constexpr std::array<PlausibleRange, 5> ranges{{
    {"Pa", "modulus", "a modulus", 1e3, 1e13},
    {"Pa", "strength", "a strength", 100, any},  // a very large one is how a bond is made unbreakable
    {"kg/m3", "density", "a density", 50, 1e5},
    {"m/s", "velocity", "a velocity", 1e-9, 100},
    {"1", "friction", "a coefficient of friction", 0, 10},
}};

std::string range_text(const PlausibleRange& r, const std::string& unit) {
  if (!std::isfinite(r.high)) return "at least " + format_quantity(r.low, unit);
  if (r.low == 0) return "at most " + format_quantity(r.high, unit);
  return format_quantity(r.low, unit) + " to " + format_quantity(r.high, unit);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> implausible_values(const Json& config, const ParamSpec& root,
                                                                    const PluginDirectory& plugins) {
  std::vector<std::pair<std::string, std::string>> found;
  Json copy = config;
  each_value(copy, root, plugins, [&](const ParamSpec& spec, const std::string& path, Json& value) {
    if (spec.type != ParamType::quantity || !value.is_number()) return;
    const double x = std::abs(value.get<double>());
    // Of a distribution the path holds the parameter's name, and the unit tells its mean from its shape.
    const std::size_t dot = path.rfind('.');
    const std::size_t above = dot == std::string::npos || dot == 0 ? std::string::npos : path.rfind('.', dot - 1);
    const std::string parent =
        dot == std::string::npos ? "" : path.substr(above == std::string::npos ? 0 : above + 1, dot - (above + 1));
    const bool of_distribution = spec.name == "mean" || spec.name == "min" || spec.name == "max";
    const std::string& name = of_distribution ? parent : spec.name;
    for (const PlausibleRange& r : ranges) {
      if (spec.unit != r.unit || name.find(r.word) == std::string::npos || x == 0) continue;
      if (x >= r.low && x <= r.high) continue;
      found.emplace_back(path, path + ": " + format_quantity(value.get<double>(), spec.unit) +
                                   " is not plausible for " + r.of + " (" + range_text(r, spec.unit) +
                                   "): is its unit right? `checks.implausible_values: false` if it is meant");
    }
  });
  return found;
}

}  // namespace breccia
