// SPDX-License-Identifier: BSD-3-Clause
/// Charts of lines or bars with one horizontal and one or two vertical axes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "painter.hpp"

namespace breccia::pictures {

struct ChartLine {
  std::string label;         ///< empty: not in the legend
  std::vector<double> x, y;  ///< as shown: already in the units of the axes; what is not finite is left out
  LineStyle style;
  bool right_axis = false;
  bool points = false;       ///< markers instead of a line
  bool every_point = false;  ///< markers at its points, not spaced along it
  double first_marker = 0;   ///< where the first marker along the line stands, as a share of their distance
};

struct ChartBar {
  double from, to, height;  ///< as shown
};

struct Chart {
  std::string x_title, left_title, right_title;  ///< without a right title there is no right axis
  std::string title;                             ///< above the axes; empty: none
  std::vector<ChartLine> lines;
  bool right_from_zero = false;
  bool equal_scales = false;   ///< circles stay round: the height follows; without a right axis
  std::vector<ChartBar> bars;  ///< they stand on zero
  std::string bars_label;

  std::size_t legend_entries() const {
    std::size_t count = !bars_label.empty();
    for (const ChartLine& line : lines) count += !line.label.empty();
    return count;
  }
};

/// One axis: where it begins and ends, at round numbers.
struct ChartAxis {
  double low = 0, high = 1;
  Ticks ticks;
  double along(double value, double from, double to) const { return from + (value - low) / (high - low) * (to - from); }
};

/// Where the legend stands: its upper left corner in pixels, and how many entries there are in a row.
struct ChartLegend {
  double left, top;
  std::size_t columns;
  double column_width;
  bool inside;  ///< on the rectangle of the axes
};

/// Where things stand, in pixels of the finished picture from its lower left corner.
struct ChartLayout {
  double width, height;
  double unit;                      ///< a hundredth of the height of the plain chart: all sizes are multiples of it
  double left, right, bottom, top;  ///< edges of the rectangle of the axes
  ChartAxis x_axis, left_axis, right_axis;
  ChartLegend legend;
  Rgb writing;  ///< colour of text and axes

  Point at(const ChartLine& line, std::size_t k) const {
    const ChartAxis& y_axis = line.right_axis ? right_axis : left_axis;
    return {x_axis.along(line.x[k], left, right), y_axis.along(line.y[k], bottom, top)};
  }
  /// The points of a line that are finite.
  std::vector<Point> points_of(const ChartLine& line) const;

  // In units.
  static constexpr double title_size = 3.4, label_size = 3.0, legend_size = 2.8, legend_row = 4.1, legend_symbol = 7;
  static constexpr double axis_line = 0.22, grid_line = 0.12, tick = 1.0, marker = 2.2;
  static constexpr double title_offset = 4;      ///< of the middle of a title from the edge of the picture
  static constexpr double marker_distance = 22;  ///< along a line
  static constexpr Rgb grid{228, 228, 228};
};

/// The legend goes into a corner that is free of lines and bars, or else below the axes. UserError when there are fewer
/// than two points to draw.
ChartLayout layout_of(const Chart& chart, const Sheet& sheet);

/// Writes <stem>.png, <stem>.svg and <stem>.pdf and adds them to `made`.
void write_chart(const Chart& chart, const Sheet& sheet, const std::filesystem::path& stem,
                 std::vector<std::filesystem::path>& made);

/// The width of a text in DejaVu Sans, rather too wide than too narrow, in type sizes.
double text_width(const std::string& text);

}  // namespace breccia::pictures
