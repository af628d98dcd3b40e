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

/// The column that was asked for, else the first that has one of these roles in the test; null when there is none.
const Curve* chosen(const CurvesFile& curves, const std::optional<std::string>& asked,
                    std::initializer_list<std::string_view> roles) {
  return asked ? curves.find(*asked) : curves.find_role(roles);
}
// The mean over the specimen, or, in a run that does not measure it, what the machine shows.
const Curve* strain_of(const CurvesFile& curves, const CurveNames& names) {
  return chosen(curves, names.strain, {role::strain, role::machine_strain});
}
const Curve* stress_of(const CurvesFile& curves, const CurveNames& names) {
  return chosen(curves, names.stress, {role::stress, role::machine_stress});
}
const Curve* displacement_of(const CurvesFile& curves, const CurveNames& names) {
  return chosen(curves, names.displacement, {role::displacement});
}
const Curve* load_of(const CurvesFile& curves, const CurveNames& names) {
  return chosen(curves, names.load, {role::load});
}
const Curve* damage_of(const CurvesFile& curves, const CurveNames& names) {
  return chosen(curves, names.damage, {role::damage});
}
/// UserError when there is none: with what there is where a name was asked for.
const Curve& needed(const Curve* curve, const CurvesFile& curves, const std::optional<std::string>& asked,
                    const char* usual) {
  return curve ? *curve : curves.at(asked.value_or(usual));
}

/// Whether what is largest of it is negative: so is a test in tension that counts compression as positive.
bool goes_down(const Curve& c) {
  double low = 0, high = 0;
  for (const double v : c.value)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  return -low > high;
}

/// The largest value, where the curve falls again: else there is no peak, only an end.
std::string mark_of(const std::vector<double>& y, std::size_t at) {
  for (std::size_t k = at + 1; k < y.size(); ++k)
    if (y[k] < 0.99 * y[at]) return "peak ";
  return "highest ";
}

/// One quantity over another with its peak marked, and damage on the right axis if there is some.
Chart curve_with_peak(const Curve& across, const Curve& up, const Curve* damage) {
  const bool down = goes_down(up), back = down && goes_down(across);
  Shown x = shown(across), y = shown(up);
  if (down) y.value = scaled(y.value, -1);
  if (back) x.value = scaled(x.value, -1);
  Chart chart;
  chart.x_title = axis_title(across, x.unit, back);
  chart.left_title = axis_title(up, y.unit, down);
  chart.lines.push_back({title(up.name, ""), x.value, y.value, {blue}});
  if (damage && largest(damage->value) > 0) {
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
  if (peak < y.value.size() && y.value[peak] > 0)
    chart.lines.push_back({mark_of(y.value, peak) + significant(y.value[peak], 4) + " " + y.unit + " at " +
                               significant(x.value[peak], 3) + " " + x.unit,
                           {x.value[peak]},
                           {y.value[peak]},
                           {ink, LineStyle::full, {}, Marker::circle},
                           false,
                           true});
  return chart;
}

/// What a column says of its sign: "compression +"; of one that is shown with the other sign "extension +".
std::string sign_of(const Curve& c, bool turned) {
  const auto says = [&](const char* what) {
    return c.doc.find(std::string(what) + " positive") != c.doc.npos ||
           c.doc.find("positive in " + std::string(what)) != c.doc.npos;
  };
  const bool strain = c.name.find("strain") != c.name.npos;
  if (says("compression")) return !turned ? ", compression +" : strain ? ", extension +" : ", tension +";
  if (says("extension")) return turned ? ", contraction +" : ", extension +";
  if (says("tension")) return turned ? ", compression +" : ", tension +";
  return turned ? ", sign turned" : "";
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

std::string axis_title(const Curve& c, const std::string& unit, bool turned) {
  std::string name = c.name;
  // Averages over the specimen are told from what platens and gauges feel, whose names say so.
  if (c.doc.starts_with("mean ") && (name.starts_with("axial") || name.starts_with("lateral") ||
                                     name.starts_with("volumetric") || name.starts_with("deviatoric_s")))
    name = "mean " + name;
  if (c.name.ends_with("strain")) name += " ε";
  else if (c.name.ends_with("stress")) name += " σ";
  else if (c.name == "global_damage") name = "broken bonds D";
  else if (c.name == "bonds_broken_tension") name = "bonds broken in tension";
  else if (c.name == "bonds_broken_shear") name = "bonds broken in shear";
  return title(name + sign_of(c, turned), unit);
}

Chart stress_strain_chart(const CurvesFile& curves, const CurveNames& names) {
  return curve_with_peak(needed(strain_of(curves, names), curves, names.strain, role::strain),
                         needed(stress_of(curves, names), curves, names.stress, role::stress),
                         damage_of(curves, names));
}

Chart load_chart(const CurvesFile& curves, const CurveNames& names) {
  return curve_with_peak(needed(displacement_of(curves, names), curves, names.displacement, role::displacement),
                         needed(load_of(curves, names), curves, names.load, role::load), damage_of(curves, names));
}

bool has_stress_strain(const CurvesFile& curves, const CurveNames& names) {
  return strain_of(curves, names) && stress_of(curves, names);
}

bool has_load(const CurvesFile& curves, const CurveNames& names) {
  return displacement_of(curves, names) && load_of(curves, names);
}

Chart strains_chart(const CurvesFile& curves, const CurveNames& names) {
  const Curve &axial = needed(strain_of(curves, names), curves, names.strain, role::strain),
              &lateral = needed(chosen(curves, names.lateral_strain, {role::lateral_strain}), curves,
                                names.lateral_strain, role::lateral_strain);
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
