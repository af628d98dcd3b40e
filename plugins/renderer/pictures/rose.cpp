// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "breccia/error.hpp"
#include "table_pictures.hpp"

namespace breccia::pictures {
namespace {

using L = ChartLayout;
using std::numbers::pi;

Point on_circle(double radius, double angle) { return radius * Point(std::cos(angle), std::sin(angle)); }

/// In pixels; the outermost circle of the grid has the radius `radius`.
class RoseDrawing {
 public:
  RoseDrawing(const Rose& rose, const Sheet& sheet) : rose_(rose), writing_(writing_on(sheet.background)) {
    side_ = sheet.size * 3 / 4;
    unit_ = side_ / 100.0;
    centre_ = {50 * unit_, 52.5 * unit_};
    radius_ = 37 * unit_;
    double most = 0;
    for (const Rose::Sector& s : rose.sectors) {
      most = std::max(most, s.percent);
      mean_ += s.percent / double(rose.sectors.size());
    }
    if (!(most > 0)) throw UserError("all fractions of the table are zero");
    const double step = nice_ticks(0, most, 4).step;
    outermost_ = step * std::ceil(most / step - 1e-9);
    rings_ = ticks_at(step, outermost_, step);
  }

  int side() const { return side_; }

  void draw(Painter& p) const {
    const Stroke grid{{175, 175, 175}, L::grid_line * unit_, {}};
    for (int degrees = 0; degrees < 360; degrees += 30) {
      const double angle = degrees * pi / 180;
      p.line(centre_, centre_ + on_circle(radius_, angle), grid);
      p.text(centre_ + on_circle(radius_ + 4.2 * unit_, angle), L::label_size * unit_, Painter::Anchor::middle,
             name_of(degrees), writing_);
    }
    for (const Rose::Sector& s : rose_.sectors) sector(p, s);
    for (const double at : rings_.at) ring(p, at, grid);  // over the sectors, which would hide them
    ring(p, mean_, {vermillion, 0.3 * unit_, {}});
    ring(p, outermost_, {writing_, L::axis_line * unit_, {}});
    for (std::size_t k = 0; k < rings_.at.size(); ++k)  // between two rays, over the sectors
      p.text(centre_ + on_circle(scaled(rings_.at[k]) + 1.3 * unit_, 75 * pi / 180), 2.2 * unit_,
             Painter::Anchor::middle, rings_.label[k], writing_);
    p.text({centre_.x(), 4 * unit_}, L::title_size * unit_, Painter::Anchor::middle, rose_.title, writing_);
    const std::string mean = "mean " + significant(mean_, 3) + " %";
    const double start = 74 * unit_, y = 95.5 * unit_;
    p.line({start, y}, {start + 4 * unit_, y}, {vermillion, 0.3 * unit_, {}});
    p.text({start + 5.2 * unit_, y}, L::legend_size * unit_, Painter::Anchor::start, mean, writing_);
  }

 private:
  double scaled(double percent) const { return radius_ * percent / outermost_; }

  std::string name_of(int degrees) const {
    if (degrees == 0 && !rose_.axis_0.empty()) return "0° " + rose_.axis_0;
    if (degrees == 90 && !rose_.axis_90.empty()) return "90° " + rose_.axis_90;
    return std::to_string(degrees) + "°";
  }

  void ring(Painter& p, double percent, const Stroke& stroke) const {
    std::vector<Point> points;
    for (int degrees = 0; degrees <= 360; degrees += 2)
      points.push_back(centre_ + on_circle(scaled(percent), degrees * pi / 180));
    p.polyline(points, stroke);
  }

  void sector(Painter& p, const Rose::Sector& s) const {
    if (!(s.percent > 0)) return;
    const int steps = std::max(2, int(std::ceil((s.to - s.from) / (pi / 90))));
    std::vector<Point> corners{centre_};
    for (int k = 0; k <= steps; ++k)
      corners.push_back(centre_ + on_circle(scaled(s.percent), s.from + k * (s.to - s.from) / steps));
    p.polygon(corners, bar_fill);
    corners.push_back(centre_);
    p.polyline(corners, {blue, 0.18 * unit_, {}});
  }

  const Rose& rose_;
  Rgb writing_;
  int side_;
  double unit_, radius_, mean_ = 0, outermost_;
  Point centre_;
  Ticks rings_;
};

}  // namespace

void write_rose(const Rose& rose, const Sheet& sheet, const std::filesystem::path& stem,
                std::vector<std::filesystem::path>& made) {
  const RoseDrawing drawing(rose, sheet);
  const Page page{drawing.side(), drawing.side(), sheet.background, rose.title};
  const Draw draw = [&](Painter& painter) { drawing.draw(painter); };
  write_chart_files(page, draw, stem, made);
}

}  // namespace breccia::pictures
