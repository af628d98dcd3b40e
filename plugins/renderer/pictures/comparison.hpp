// SPDX-License-Identifier: BSD-3-Clause
/// One quantity of several runs in one chart.
#pragma once

#include "breccia/renderer.hpp"
#include "chart.hpp"
#include "curves_file.hpp"

namespace breccia::pictures {

struct Comparison {
  std::string x, y;
  std::optional<std::string> name;

  std::string file_name() const { return name.value_or(y); }
  static void describe(Schema<Comparison>& s) {
    s.param("x", &Comparison::x).fallback("axial_strain").doc("column of the horizontal axis");
    s.param("y", &Comparison::y).example("mean_stress").doc("column of the vertical axis");
    s.param("name", &Comparison::name).doc("file name without its ending; the value of `y` if absent");
  }
};

/// What is drawn when the user asks for nothing: as Figs 12, 13, 15-17, 19, 20, 22-24 of Rojek et al. (2012).
const std::vector<Comparison>& usual_comparisons();

struct LabelledCurves {
  std::string label;
  CurvesFile curves;
};

/// The runs that have both columns; `missing` gets the labels of the others. UserError when there is none, or when a
/// column's unit is not the same in all of them.
Chart comparison_chart(const std::vector<LabelledCurves>& runs, const Comparison& comparison,
                       std::vector<std::string>& missing);

/// A chart of a parameter study. UserError when there are fewer than two points.
Chart study_chart(const StudyChart& study);

}  // namespace breccia::pictures
