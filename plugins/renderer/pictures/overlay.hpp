// SPDX-License-Identifier: BSD-3-Clause
/// What is written over a scene: colour bar, legend, scale bar, directions and caption.
#pragma once

#include <vtkContextItem.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <vector>

#include "breccia/types.hpp"
#include "style.hpp"

namespace breccia::pictures {

struct ColourBar {
  vtkSmartPointer<vtkLookupTable> colours;
  std::string title;
  Ticks ticks;               ///< in shown units
  double low = 0, high = 1;  ///< in shown units
};

struct LegendEntry {
  Rgb colour;
  std::string text;
};

/// All lengths in pixels of the finished picture; the origin is its lower left corner.
class Overlay final : public vtkContextItem {
 public:
  vtkTypeMacro(Overlay, vtkContextItem);
  static Overlay* New();

  int width = 0, height = 0;  ///< of the picture
  double scale = 1;           ///< drawn pixels per pixel of the picture
  Rgb colour = ink;           ///< of text and lines
  std::optional<ColourBar> bar;
  std::vector<LegendEntry> legend;
  double scale_bar = 0;  ///< length in pixels; 0: none
  std::string scale_text;
  std::vector<std::pair<Eigen::Vector2d, std::string>>
      directions;  ///< unit vectors seen by the camera, with their names
  std::string caption;

  static constexpr double share_of_bar = 0.2;  ///< of the height: the width kept free at the right for bar or legend
  bool Paint(vtkContext2D* painter) override;

 private:
  double unit() const { return height / 100.0; }  ///< all sizes follow the picture's height
  void set_text(vtkContext2D* painter, double size, int horizontal, int vertical, double turn = 0,
                bool bold = false) const;
  void line(vtkContext2D* painter, double x1, double y1, double x2, double y2, double thickness) const;
  void text(vtkContext2D* painter, double x, double y, const std::string& what) const;
  void paint_bar(vtkContext2D* painter) const;
  void paint_legend(vtkContext2D* painter) const;
  void paint_scale(vtkContext2D* painter) const;
  void paint_directions(vtkContext2D* painter) const;
};

}  // namespace breccia::pictures
