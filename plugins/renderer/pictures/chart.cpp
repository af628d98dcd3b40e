// SPDX-License-Identifier: BSD-3-Clause
#include "chart.hpp"

#include <cmath>

namespace breccia::pictures {
namespace {

using L = ChartLayout;
using Anchor = Painter::Anchor;

void draw_marker(Painter& p, Marker marker, const Point& c, double size, const Rgb& colour) {
  const double r = 0.5 * size;
  const auto around = [&](std::initializer_list<Point> corners) {
    std::vector<Point> at;
    for (const Point& q : corners) at.push_back(c + r * q);
    p.polygon(at, colour);
  };
  switch (marker) {
    case Marker::none:
      break;
    case Marker::circle:
      p.disc(c, r, colour);
      break;
    case Marker::square:
      around({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
      break;
    case Marker::triangle_up:
      around({{-1.1, -0.8}, {1.1, -0.8}, {0, 1.2}});
      break;
    case Marker::diamond:
      around({{-1.25, 0}, {0, -1.25}, {1.25, 0}, {0, 1.25}});
      break;
    case Marker::triangle_down:
      around({{-1.1, 0.8}, {0, -1.2}, {1.1, 0.8}});
      break;
  }
}

Stroke stroke_of(const LineStyle& style, double u) {
  Stroke stroke{style.colour, style.width * u, {}};
  for (const double d : style.dashes) stroke.dashes.push_back(d * u);
  return stroke;
}

void draw_line(Painter& p, const ChartLine& line, const L& l) {
  const std::vector<Point> points = l.points_of(line);
  const double size = L::marker * l.unit, distance = L::marker_distance * l.unit;
  if (line.points) {
    for (const Point& at : points) draw_marker(p, line.style.marker, at, size, line.style.colour);
    return;
  }
  if (points.size() < 2) return;
  p.polyline(points, stroke_of(line.style, l.unit));
  if (line.every_point) {
    for (const Point& at : points) draw_marker(p, line.style.marker, at, size, line.style.colour);
    return;
  }
  double next = line.first_marker * distance;  // way to go
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Point way = points[k] - points[k - 1];
    for (; next <= way.norm(); next += distance)
      draw_marker(p, line.style.marker, points[k - 1] + next / way.norm() * way, size, line.style.colour);
    next -= way.norm();
  }
}

void draw_grid(Painter& p, const L& l) {
  const Stroke thin{L::grid, L::grid_line * l.unit, {}};
  for (const double at : l.x_axis.ticks.at) {
    const double x = l.x_axis.along(at, l.left, l.right);
    p.line({x, l.bottom}, {x, l.top}, thin);
  }
  for (const double at : l.left_axis.ticks.at) {
    const double y = l.left_axis.along(at, l.bottom, l.top);
    p.line({l.left, y}, {l.right, y}, thin);
  }
}

void draw_bars(Painter& p, const Chart& chart, const L& l) {
  for (const ChartBar& bar : chart.bars) {
    const double x1 = l.x_axis.along(bar.from, l.left, l.right), x2 = l.x_axis.along(bar.to, l.left, l.right),
                 y1 = l.left_axis.along(0, l.bottom, l.top), y2 = l.left_axis.along(bar.height, l.bottom, l.top);
    if (!(bar.height > 0)) continue;
    p.polygon({{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}}, bar_fill);
    p.polyline({{x1, y1}, {x1, y2}, {x2, y2}, {x2, y1}}, {blue, 0.2 * l.unit, {}});
  }
}

void draw_axes(Painter& p, const Chart& chart, const L& l) {
  const double u = l.unit;
  const Stroke pen{l.writing, L::axis_line * u, {}};
  p.line({l.left, l.bottom}, {l.right, l.bottom}, pen);
  for (std::size_t k = 0; k < l.x_axis.ticks.at.size(); ++k) {
    const double x = l.x_axis.along(l.x_axis.ticks.at[k], l.left, l.right);
    p.line({x, l.bottom}, {x, l.bottom - L::tick * u}, pen);
    p.text({x, l.bottom - 3.4 * u}, L::label_size * u, Anchor::middle, l.x_axis.ticks.label[k], l.writing);
  }
  const auto vertical = [&](const ChartAxis& axis, double x, double outward, Anchor anchor) {
    p.line({x, l.bottom}, {x, l.top}, pen);
    for (std::size_t k = 0; k < axis.ticks.at.size(); ++k) {
      const double y = axis.along(axis.ticks.at[k], l.bottom, l.top);
      p.line({x, y}, {x + outward * L::tick * u, y}, pen);
      p.text({x + outward * 1.9 * u, y}, L::label_size * u, anchor, axis.ticks.label[k], l.writing);
    }
  };
  const double middle_x = 0.5 * (l.left + l.right), middle_y = 0.5 * (l.bottom + l.top), offset = L::title_offset * u;
  const double below = l.bottom - 10 * u, size = L::title_size * u;
  vertical(l.left_axis, l.left, -1, Anchor::end);
  p.text({middle_x, below}, size, Anchor::middle, chart.x_title, l.writing);
  p.text({offset, middle_y}, size, Anchor::middle, chart.left_title, l.writing, true);
  if (chart.right_title.empty()) return;
  vertical(l.right_axis, l.right, 1, Anchor::start);
  p.text({l.width - offset, middle_y}, size, Anchor::middle, chart.right_title, l.writing, true);
}

void draw_legend(Painter& p, const Chart& chart, const L& l, const Rgb& paper) {
  const double u = l.unit;
  std::size_t k = 0;
  const std::size_t entries = chart.legend_entries();
  const double depth = double((entries + l.legend.columns - 1) / l.legend.columns) * L::legend_row * u;
  const double right = l.legend.left + double(l.legend.columns) * l.legend.column_width, bottom = l.legend.top - depth;
  if (l.legend.inside && entries > 0)  // so that no grid lines run through the words
    p.polygon({{l.legend.left, bottom}, {right, bottom}, {right, l.legend.top}, {l.legend.left, l.legend.top}}, paper);
  const auto next = [&] {
    const Point at(l.legend.left + double(k % l.legend.columns) * l.legend.column_width + u,
                   l.legend.top - (double(k / l.legend.columns) + 0.5) * L::legend_row * u);
    ++k;
    return at;
  };
  const auto write = [&](const Point& at, const std::string& label) {
    p.text(at + Point((L::legend_symbol + 1.5) * u, 0), L::legend_size * u, Anchor::start, label, l.writing);
  };
  if (!chart.bars_label.empty()) {
    const Point at = next(), w(L::legend_symbol * u, 0), h(0, 0.8 * u);
    p.polygon({at - h, at + w - h, at + w + h, at + h}, bar_fill);
    write(at, chart.bars_label);
  }
  for (const ChartLine& line : chart.lines) {
    if (line.label.empty()) continue;
    const Point at = next(), middle = at + Point(0.5 * L::legend_symbol * u, 0);
    if (!line.points) p.line(at, at + Point(L::legend_symbol * u, 0), stroke_of(line.style, u));
    draw_marker(p, line.style.marker, middle, L::marker * u, line.style.colour);
    write(at, line.label);
  }
}

}  // namespace

void write_chart(const Chart& chart, const Sheet& sheet, const std::filesystem::path& stem,
                 std::vector<std::filesystem::path>& made) {
  const ChartLayout layout = layout_of(chart, sheet);
  const Page page{int(std::lround(layout.width)), int(std::lround(layout.height)), sheet.background,
                  chart.title.empty() ? chart.left_title + " against " + chart.x_title : chart.title};
  const Draw draw = [&](Painter& painter) {
    draw_grid(painter, layout);
    draw_bars(painter, chart, layout);
    for (const ChartLine& line : chart.lines) draw_line(painter, line, layout);
    draw_axes(painter, chart, layout);
    draw_legend(painter, chart, layout, bytes_of(sheet.background));
    if (!chart.title.empty())
      painter.text({0.5 * (layout.left + layout.right), layout.top + 4 * layout.unit}, L::title_size * layout.unit,
                   Anchor::middle, chart.title, layout.writing);
  };
  write_chart_files(page, draw, stem, made);
}

}  // namespace breccia::pictures
