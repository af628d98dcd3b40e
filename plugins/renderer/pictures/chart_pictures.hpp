// SPDX-License-Identifier: BSD-3-Clause
/// The charts made of curves.csv.
#pragma once

#include "breccia/schema.hpp"
#include "chart.hpp"
#include "curves_file.hpp"

namespace breccia::pictures {

/// Which columns are drawn, by header or by name without the unit.
struct CurveNames {
  std::string strain, stress, damage, lateral_strain;

  static void describe(Schema<CurveNames>& s) {
    s.param("strain", &CurveNames::strain).fallback("axial_strain").doc("horizontal axis");
    s.param("stress", &CurveNames::stress).fallback("axial_stress").doc("left axis, compression positive");
    s.param("damage", &CurveNames::damage)
        .fallback("global_damage")
        .doc("right axis of `stress_strain`, if there is such a column");
    s.param("lateral_strain", &CurveNames::lateral_strain).fallback("lateral_strain").doc("left axis of `strains`");
  }
};

/// Axial stress and, if that column exists, damage against axial strain, with the peak marked.
Chart stress_strain_chart(const CurvesFile& curves, const CurveNames& names);

/// Lateral against axial strain.
Chart strains_chart(const CurvesFile& curves, const CurveNames& names);

}  // namespace breccia::pictures
