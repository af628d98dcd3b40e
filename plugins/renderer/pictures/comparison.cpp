// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.hpp"

#include <algorithm>
#include <numbers>

#include "breccia/error.hpp"
#include "chart_pictures.hpp"

namespace breccia::pictures {
namespace {

/// One column of several runs in one unit.
struct Shared {
  std::vector<std::vector<double>> value;
  std::string title;
};

Shared in_one_unit(const std::vector<const Curve*>& curves) {
  double most = 0;
  for (const Curve* c : curves) {
    if (c->unit != curves[0]->unit)
      throw UserError("column `" + c->name + "` is in " + (c->unit.empty() ? "pure numbers" : c->unit) +
                      " in one run and in " + (curves[0]->unit.empty() ? "pure numbers" : curves[0]->unit) +
                      " in another");
    most = std::max(most, largest(c->value));
  }
  const ShownUnit unit = unit_of_axis(*curves[0], most);
  Shared s;
  for (const Curve* c : curves) s.value.push_back(scaled(c->value, unit.factor));
  s.title = axis_title(*curves[0], unit.unit);
  return s;
}

}  // namespace

const std::vector<Comparison>& usual_comparisons() {
  static const std::vector<Comparison> all = {{"axial_strain", "axial_stress", "stress_strain"},
                                              {"axial_strain", "bonds_broken_tension", "broken_tension"},
                                              {"axial_strain", "bonds_broken_shear", "broken_shear"},
                                              {"axial_strain", "global_damage", "global_damage"}};
  return all;
}

Chart comparison_chart(const std::vector<LabelledCurves>& runs, const Comparison& comparison,
                       std::vector<std::string>& missing) {
  std::vector<const Curve*> x, y;
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Curve *a = runs[k].curves.find(comparison.x), *b = runs[k].curves.find(comparison.y);
    if (a && b) {
      x.push_back(a);
      y.push_back(b);
      which.push_back(k);
    } else {
      missing.push_back(runs[k].label);
    }
  }
  if (which.empty()) {
    for (const std::string& name : {comparison.x, comparison.y}) runs[0].curves.at(name);  // says what there is
    throw UserError("no run has both `" + comparison.x + "` and `" + comparison.y + "`");
  }
  Shared across = in_one_unit(x), up = in_one_unit(y);
  Chart chart;
  chart.x_title = across.title;
  chart.left_title = up.title;
  for (std::size_t k = 0; k < which.size(); ++k)
    chart.lines.push_back({runs[which[k]].label, std::move(across.value[k]), std::move(up.value[k]),
                           series_style(which[k]), false, false, false, double(k + 1) / double(which.size())});
  return chart;
}

Chart study_chart(const StudyChart& study) {
  double most_x = 0, most_y = 0;
  for (const StudyChart::Series& s : study.series) {
    most_x = std::max(most_x, largest(s.x));
    most_y = std::max(most_y, largest(s.y));
  }
  const auto unit = [](const StudyChart::Axis& axis, double most) {
    if (axis.unit == "rad") return ShownUnit{180 / std::numbers::pi, "°"};
    return axis.unit == "1" ? ShownUnit{} : shown_unit(axis.unit, most);
  };
  const ShownUnit across = unit(study.x, most_x), up = unit(study.y, most_y);
  Chart chart;
  chart.x_title = title(study.x.title, across.unit);
  chart.left_title = title(study.y.title, up.unit);
  for (std::size_t k = 0; k < study.series.size(); ++k) {
    const StudyChart::Series& s = study.series[k];
    LineStyle style = series_style(k);
    if (style.marker == Marker::none) style.marker = Marker::circle;  // each point is a run and is marked as such
    const bool alone = !s.joined || s.x.size() < 2;
    chart.lines.push_back({s.label, scaled(s.x, across.factor), scaled(s.y, up.factor), style, false, alone, true});
  }
  return chart;
}

}  // namespace breccia::pictures
