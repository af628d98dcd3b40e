// SPDX-License-Identifier: BSD-3-Clause
/// How the pictures look: type, colour maps, units and ticks.
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>
#include <vector>

#include "breccia/types.hpp"

class vtkTextProperty;

namespace breccia::pictures {

using Rgb = std::array<unsigned char, 3>;

/// Okabe and Ito's colours, told apart by colour-blind readers too.
constexpr Rgb blue{0, 114, 178}, vermillion{213, 94, 0}, green{0, 158, 115}, ink{38, 38, 38};

/// The areas of histograms, paler than their blue outlines.
constexpr Rgb bar_fill{153, 199, 224};

enum class Marker { none, circle, square, triangle_up, diamond, triangle_down };

/// Lengths are in hundredths of a chart's height.
struct LineStyle {
  static constexpr double full = 0.55, thin = 0.4;
  Rgb colour = ink;
  double width = full;
  std::vector<double> dashes = {};  ///< lengths of line and gap in turn; empty: a full line
  Marker marker = Marker::none;
};
LineStyle dashed(const Rgb& colour);
/// The k-th of several curves: colour, dashes and marker change together, so that black-and-white print keeps them
/// apart. No two of the first 210 are alike.
LineStyle series_style(std::size_t k);

/// The 0 to 255 form of a colour given in 0 to 1.
Rgb bytes_of(const Vec3& colour);

/// The colour of text and lines on a background (red, green, blue in 0 to 1).
Rgb writing_on(const Vec3& background);

enum class ColourMap { automatic, viridis, cividis, inferno, orange_red, blue_red, grey };

/// 256 steps from `low` to `high`. Not for `automatic`.
vtkSmartPointer<vtkLookupTable> lookup_table(ColourMap map, double low, double high);

/// DejaVu Sans, which has Greek letters; VTK's own sans serif when it is not installed.
void set_type(vtkTextProperty* text, int size, const Rgb& colour, bool bold = false);

/// The factor and the unit with the prefix that bring numbers up to `largest` into 1 to 1000; for areas and volumes,
/// the side of a square or cube of that size.
struct ShownUnit {
  double factor = 1;
  std::string unit;  ///< empty for a pure number
};
ShownUnit shown_unit(const std::string& si_unit, double largest);

/// Round numbers within [low, high], about `count` of them, and their labels with just enough digits.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> label;
  double step = 1;
};
Ticks nice_ticks(double low, double high, int count);
/// The multiples of `step` within [low, high].
Ticks ticks_at(double low, double high, double step);

/// "axial strain (%)"; underscores become blanks.
std::string title(std::string name, const std::string& unit);

/// printf's %.*g.
std::string significant(double value, int digits);

}  // namespace breccia::pictures
