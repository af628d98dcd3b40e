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
  std::optional<std::string> strain, stress, displacement, damage, lateral_strain, load;

  static void describe(Schema<CurveNames>& s) {
    s.param("strain", &CurveNames::strain)
        .example("axial_strain")
        .doc("horizontal axis; if absent the specimen's axial strain, or else that of the platens");
    s.param("stress", &CurveNames::stress)
        .example("axial_stress")
        .doc("left axis, compression positive; if absent the specimen's axial stress, or else that of the platens");
    s.param("damage", &CurveNames::damage)
        .example("global_damage")
        .doc(
            "right axis of `stress_strain` and `load_curve`; if absent the share of broken bonds, where it is "
            "measured");
    s.param("lateral_strain", &CurveNames::lateral_strain)
        .example("lateral_strain")
        .doc("left axis of `strains`; if absent the specimen's lateral strain");
    s.param("displacement", &CurveNames::displacement)
        .example("platen_displacement")
        .doc("horizontal axis of `load_curve`; if absent how far the test says that what loads has gone");
    s.param("load", &CurveNames::load).example("load").doc("left axis of `load_curve`; if absent the test's own load");
  }
};

/// Axial stress and, if that column exists, damage against axial strain, with the peak marked. A test in tension is
/// shown with tension positive.
Chart stress_strain_chart(const CurvesFile& curves, const CurveNames& names);

/// The load against the displacement of what loads in the same way.
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
/// "mean axial strain ε, compression + (%)": which one it is and how its sign is meant, as far as curves.json says so,
/// and the customary symbol. `turned`: it is shown with the other sign.
std::string axis_title(const Curve& curve, const std::string& unit, bool turned = false);

}  // namespace breccia::pictures
