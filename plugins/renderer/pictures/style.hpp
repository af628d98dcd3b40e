// SPDX-License-Identifier: BSD-3-Clause
/// How the pictures look: type, colour maps, units and ticks.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "breccia/shown_unit.hpp"
#include "breccia/types.hpp"
#include "caster.hpp"

namespace breccia::pictures {

/// Okabe and Ito's colours, told apart by colour-blind readers too.
constexpr Rgb blue{0, 114, 178}, vermillion{213, 94, 0}, green{0, 158, 115}, ink{38, 38, 38}, orange{230, 159, 0},
    sky_blue{86, 180, 233}, purple{204, 121, 167}, yellow{240, 228, 66};

/// The areas of histograms, paler than their blue outlines.
constexpr Rgb bar_fill{153, 199, 224};

struct Sheet {
  int size = 1600;  ///< height of a picture of the specimen, width of a chart [pixels]
  Vec3 background = Vec3::Ones();
  int threads = 1;  ///< the same picture for any number
};

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

/// Colours of values from `low` to `high`; what lies beyond takes the last colour.
struct ColourTable {
  std::array<Rgb, 256> step;
  double low = 0, high = 1;
  const Rgb& at(double value) const;
};
/// Not for `automatic`.
ColourTable colour_table(ColourMap map, double low, double high);

/// The file of DejaVu Sans, which has Greek letters; empty when it is not installed.
std::string font_file();
/// From the base line of a text to the middle of its height, in type sizes.
constexpr double middle_of_type = 0.36;

/// Round numbers within [low, high], about `count` of them, and their labels with just enough digits.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> label;
  double step = 1;
};
/// Of whole numbers the least step is 1.
Ticks nice_ticks(double low, double high, int count, double least_step = 0);
/// The multiples of `step` within [low, high].
Ticks ticks_at(double low, double high, double step);

/// "axial strain (%)"; underscores become blanks.
std::string title(std::string name, const std::string& unit);

/// printf's %.*g.
std::string significant(double value, int digits);
/// "12 345", with narrow blanks.
std::string whole_number(double value);

}  // namespace breccia::pictures
