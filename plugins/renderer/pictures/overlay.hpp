// SPDX-License-Identifier: BSD-3-Clause
/// What is written over a scene: colour bar, legend, scale bar, directions and caption.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "painter.hpp"

namespace breccia::pictures {

struct ColourBar {
  ColourTable colours;
  std::string title;
  Ticks ticks;               ///< in shown units
  double low = 0, high = 1;  ///< in shown units
};

struct LegendEntry {
  Rgb colour;
  std::string text;
};

/// All lengths in pixels of the finished picture; the origin is its lower left corner.
class Overlay {
 public:
  int width = 0, height = 0;  ///< of the picture
  double unit = 0;            ///< all sizes of writing are multiples of it [pixels]
  Rgb colour = ink;           ///< of text and lines
  std::optional<ColourBar> bar;
  std::vector<LegendEntry> legend;
  double scale_bar = 0;  ///< length in pixels; 0: none
  std::string scale_text;
  std::vector<std::pair<Eigen::Vector2d, std::string>>
      directions;                               ///< unit vectors seen by the camera, with their names
  std::vector<std::string> captions;            ///< at the lower right, from below
  std::string title;                            ///< at the upper edge
  std::vector<std::pair<Point, Point>> arrows;  ///< from, to

  static constexpr double share_of_bar = 0.2;  ///< of the height: the width kept free at the right for bar or legend
  void paint(Painter& painter) const;

 private:
  void line(Painter& painter, double x1, double y1, double x2, double y2, double thickness) const;
  void paint_bar(Painter& painter) const;
  void paint_legend(Painter& painter) const;
  void paint_scale(Painter& painter) const;
  void paint_directions(Painter& painter) const;
  void paint_arrow(Painter& painter, const Point& from, const Point& to) const;
};

}  // namespace breccia::pictures
