// SPDX-License-Identifier: BSD-3-Clause
/// The charts made of curves.csv.
#pragma once

#include <optional>

#include "breccia/schema.hpp"
#include "chart.hpp"
#include "curves_file.hpp"

namespace breccia::pictures {

/// Which columns are drawn, by header or by name without the unit.
struct CurveNames {
  std::optional<std::string> strain, stress;
  std::string damage, lateral_strain, displacement, load;

  static void describe(Schema<CurveNames>& s) {
    s.param("strain", &CurveNames::strain)
        .example("axial_strain")
        .doc("horizontal axis; if absent `axial_strain`, or else `platen_strain`");
    s.param("stress", &CurveNames::stress)
        .example("axial_stress")
        .doc("left axis, compression positive; if absent `axial_stress`, or else `platen_stress`");
    s.param("damage", &CurveNames::damage)
        .fallback("global_damage")
        .doc("right axis of `stress_strain` and `load_curve`, if there is such a column");
    s.param("lateral_strain", &CurveNames::lateral_strain).fallback("lateral_strain").doc("left axis of `strains`");
    s.param("displacement", &CurveNames::displacement)
        .fallback("platen_displacement")
        .doc("horizontal axis of `load_curve`");
    s.param("load", &CurveNames::load).fallback("load").doc("left axis of `load_curve`");
  }
};

/// Axial stress and, if that column exists, damage against axial strain, with the peak marked.
Chart stress_strain_chart(const CurvesFile& curves, const CurveNames& names);

/// The load of the platens against their displacement in the same way.
Chart load_chart(const CurvesFile& curves, const CurveNames& names);

/// Lateral against axial strain.
Chart strains_chart(const CurvesFile& curves, const CurveNames& names);

/// Whether the columns that a chart needs are there.
bool has_stress_strain(const CurvesFile& curves, const CurveNames& names);
bool has_load(const CurvesFile& curves, const CurveNames& names);

// What these have in common with other charts of curves.
std::vector<double> scaled(const std::vector<double>& v, double factor);
/// The largest magnitude among the finite values.
double largest(const std::vector<double>& v);
/// Strains and shares in percent, counts as they are, what has a unit with the prefix that fits its largest value.
ShownUnit unit_of_axis(const Curve& curve, double most);
/// "axial strain ε (%)": with the customary sign of the quantities that have one.
std::string axis_title(const Curve& curve, const std::string& unit);

}  // namespace breccia::pictures
