// SPDX-License-Identifier: BSD-3-Clause
/// A flat sheet to draw charts, and the writing over scenes, on. What is drawn once becomes a .png and a .svg of the
/// same look.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "style.hpp"

namespace breccia::pictures {

/// Pixels of the finished picture from its lower left corner.
using Point = Eigen::Vector2d;

struct Stroke {
  Rgb colour;
  double width;                ///< [pixels]
  std::vector<double> dashes;  ///< lengths of line and gap in turn [pixels]; empty: a full line
};

class Painter {
 public:
  virtual ~Painter() = default;
  virtual void polyline(const std::vector<Point>& points, const Stroke& stroke) = 0;
  /// A convex area.
  virtual void polygon(const std::vector<Point>& corners, const Rgb& fill) = 0;
  virtual void disc(const Point& centre, double radius, const Rgb& fill) = 0;
  enum class Anchor { start, middle, end };
  /// `at` is the middle of the text's height; `upright` text runs from below to above.
  virtual void text(const Point& at, double size, Anchor anchor, const std::string& what, const Rgb& colour,
                    bool upright = false) = 0;

  void line(const Point& from, const Point& to, const Stroke& stroke) { polyline({from, to}, stroke); }
};

struct Page {
  int width, height;  ///< [pixels]
  Vec3 background;
  std::string title;             ///< of the .svg, for those who cannot see it
  const Image* scene = nullptr;  ///< of the same size, under what is drawn; in the .png alone
};

using Draw = std::function<void(Painter&)>;
void write_png(const Page& page, const Draw& draw, const std::filesystem::path& file);
/// Text stays text, to be edited in a drawing program.
void write_svg(const Page& page, const Draw& draw, const std::filesystem::path& file);
/// As wide as the text of a printed page, with its type within.
void write_pdf(const Page& page, const Draw& draw, const std::filesystem::path& file);
/// Writes <stem>.png, <stem>.svg and <stem>.pdf and adds them to `made`.
void write_chart_files(const Page& page, const Draw& draw, const std::filesystem::path& stem,
                       std::vector<std::filesystem::path>& made);
/// What write_png would write.
Image flat(const Page& page, const Draw& draw);

}  // namespace breccia::pictures
