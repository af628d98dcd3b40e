// SPDX-License-Identifier: BSD-3-Clause
/// The charts made of the tables of a run: histograms, roses of directions, and profiles.
#pragma once

#include "chart.hpp"
#include "curves_file.hpp"

namespace breccia::pictures {

/// A table that begins with the columns `from`, `to` and has `count` and `fraction`.
bool is_histogram(const CurvesFile& table);
/// `name` is that of the table: "histogram_particle_radius".
Chart histogram_chart(const CurvesFile& table, const std::string& name);

/// A table that begins with `angle_from_rad`, `angle_to_rad` and has `count` and `fraction`.
bool is_rose(const CurvesFile& table);

/// Another table that begins with an interval, `from` and `to` or names that end in these: a line chart over the
/// middles of the intervals of those columns whose names begin as the last one's does, up to its first underscore.
bool is_profile(const CurvesFile& table);
Chart profile_chart(const CurvesFile& table, const std::string& name);

/// A histogram in polar coordinates: a sector for each interval of angles, its radius the fraction.
struct Rose {
  std::string title, axis_0, axis_90;  ///< names of the directions at 0° and 90°; empty: none
  struct Sector {
    double from, to, percent;  ///< [rad], counted from the right to the left
  };
  std::vector<Sector> sectors;
};
Rose rose_of(const CurvesFile& table, const std::string& name);
/// Writes <stem>.png, <stem>.svg and <stem>.pdf and adds them to `made`.
void write_rose(const Rose& rose, const Sheet& sheet, const std::filesystem::path& stem,
                std::vector<std::filesystem::path>& made);

}  // namespace breccia::pictures
