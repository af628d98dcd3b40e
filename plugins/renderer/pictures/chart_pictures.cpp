// SPDX-License-Identifier: BSD-3-Clause
#include "chart_pictures.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::pictures {
namespace {

/// A column as an axis shows it.
struct Shown {
  std::vector<double> value;
  std::string unit;
};
Shown shown(const Curve& c) {
  const ShownUnit unit = unit_of_axis(c, largest(c.value));
  return {scaled(c.value, unit.factor), unit.unit};
}

}  // namespace

std::vector<double> scaled(const std::vector<double>& v, double factor) {
  std::vector<double> out(v);
  for (double& x : out) x *= factor;
  return out;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v)
    if (std::isfinite(x)) most = std::max(most, std::abs(x));
  return most;
}

ShownUnit unit_of_axis(const Curve& c, double most) {
  if (!c.unit.empty()) return shown_unit(c.unit, most);
  for (const char* share : {"strain", "damage", "share", "ratio", "fraction"})
    if (c.name.find(share) != c.name.npos) return {100, "%"};
  return {};
}

std::string axis_title(const Curve& c, const std::string& unit) {
  std::string name = c.name;
  if (c.name.ends_with("strain")) name += " ε";
  else if (c.name.ends_with("stress")) name += " σ";
  else if (c.name == "global_damage") name = "broken bonds D";
  else if (c.name == "bonds_broken_tension") name = "bonds broken in tension";
  else if (c.name == "bonds_broken_shear") name = "bonds broken in shear";
  return title(name, unit);
}

Chart stress_strain_chart(const CurvesFile& curves, const CurveNames& names) {
  const Curve &strain = curves.at(names.strain), &stress = curves.at(names.stress);
  const Curve* damage = curves.find(names.damage);
  const Shown x = shown(strain), y = shown(stress);
  Chart chart;
  chart.x_title = axis_title(strain, x.unit);
  chart.left_title = axis_title(stress, y.unit);
  chart.lines.push_back({title(stress.name, ""), x.value, y.value, {blue}});
  if (damage) {
    const Shown d = shown(*damage);
    chart.right_title = axis_title(*damage, d.unit);
    chart.right_from_zero = damage->unit.empty();
    chart.lines.push_back({damage->name == "global_damage" ? "broken bonds" : title(damage->name, ""), x.value, d.value,
                           dashed(vermillion), true});
  }
  std::size_t peak = y.value.size();
  for (std::size_t k = 0; k < y.value.size(); ++k)
    if (std::isfinite(y.value[k]) && std::isfinite(x.value[k]) &&
        (peak == y.value.size() || y.value[k] > y.value[peak]))
      peak = k;
  if (peak < y.value.size())
    chart.lines.push_back(
        {"peak " + significant(y.value[peak], 4) + " " + y.unit + " at " + significant(x.value[peak], 3) + " " + x.unit,
         {x.value[peak]},
         {y.value[peak]},
         {ink, LineStyle::full, {}, Marker::circle},
         false,
         true});
  return chart;
}

Chart strains_chart(const CurvesFile& curves, const CurveNames& names) {
  const Curve &axial = curves.at(names.strain), &lateral = curves.at(names.lateral_strain);
  const Shown x = shown(axial), y = shown(lateral);
  Chart chart;
  chart.x_title = axis_title(axial, x.unit);
  chart.left_title = axis_title(lateral, y.unit);
  chart.lines.push_back({title(lateral.name, ""), x.value, y.value, {blue}});
  if (const Curve* volumetric = curves.find("volumetric_strain"))
    chart.lines.push_back({title(volumetric->name, ""), x.value, shown(*volumetric).value, dashed(green)});
  if (chart.lines.size() > 1) chart.left_title = "strain ε (%)";
  return chart;
}

}  // namespace breccia::pictures
