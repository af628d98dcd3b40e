// SPDX-License-Identifier: BSD-3-Clause
/// Line charts with one horizontal and one or two vertical axes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene_pictures.hpp"
#include "style.hpp"

namespace breccia::pictures {

struct ChartLine {
  std::string label;
  std::vector<double> x, y;      ///< as shown: already in the units of the axes; what is not finite is left out
  Rgb colour;
  bool right_axis = false;
  bool points = false;           ///< markers instead of a line
  bool dashed = false;
};

struct Chart {
  std::string x_title, left_title, right_title;  ///< without a right title there is no right axis
  std::vector<ChartLine> lines;
  bool right_from_zero = false;
};

/// One axis: where it begins and ends, at round numbers.
struct ChartAxis {
  double low = 0, high = 1;
  Ticks ticks;
};

/// Where things stand, in pixels of the finished picture from its lower left corner. Both formats follow it.
struct ChartLayout {
  double width, height;
  double unit;                        ///< a hundredth of the height: all sizes are multiples of it
  double left, right, bottom, top;    ///< edges of the rectangle of the axes
  ChartAxis x_axis, left_axis, right_axis;
  Rgb writing;                        ///< colour of text and axes

  // In units.
  static constexpr double title_size = 3.4, label_size = 3.0, legend_size = 2.8;
  static constexpr double line = 0.55, dashed_line = 0.4, axis_line = 0.22, grid_line = 0.12, tick = 1.0, marker = 2.2;
  static constexpr double title_offset = 4;  ///< of the middle of a title from the edge of the picture
  static constexpr Rgb grid{228, 228, 228};
};

/// UserError when there are fewer than two points to draw.
ChartLayout layout_of(const Chart& chart, const Sheet& sheet);

void write_png(const Chart& chart, const ChartLayout& layout, const Sheet& sheet, const std::filesystem::path& file);
/// Text stays text, to be edited in a drawing program.
void write_svg(const Chart& chart, const ChartLayout& layout, const Sheet& sheet, const std::filesystem::path& file);

}  // namespace breccia::pictures
