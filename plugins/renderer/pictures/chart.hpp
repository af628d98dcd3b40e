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
  std::vector<double> x, y;      ///< as shown: already in the units of the axes
  Rgb colour;
  bool right_axis = false;
  bool points = false;           ///< markers instead of a line
  bool dashed = false;
};

struct Chart {
  std::string x_title, left_title, right_title;  ///< without a right title there is no right axis
  std::vector<ChartLine> lines;
  bool right_from_zero_to_full = false;          ///< the right axis ends at 100 (a share in percent)
};

/// Writes a PNG and an SVG file. UserError when there are fewer than two points to draw.
void draw_chart(const Chart& chart, const Sheet& sheet, const std::filesystem::path& png,
                const std::filesystem::path& svg);

}  // namespace breccia::pictures
