// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "breccia/error.hpp"
#include "chart.hpp"

namespace breccia::pictures {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  std::size_t most = 0;  // points of the longest line

  void include(const std::vector<double>& at, const std::vector<double>& other) {
    std::size_t points = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (!std::isfinite(at[k]) || !std::isfinite(other[k])) continue;
      low = std::min(low, at[k]);
      high = std::max(high, at[k]);
      ++points;
    }
    most = std::max(most, points);
  }

  /// Ends at round numbers; begins at zero when it begins near it.
  ChartAxis rounded() const {
    double a = low, b = high;
    if (!(a <= b)) return {0, 1, nice_ticks(0, 1, 6)};
    if (a > 0 && a < 0.3 * b) a = 0;
    if (a < 0 && a > -0.002 * b) a = 0;  // less than half the width of a line
    if (!(b > a)) b = a + (a != 0 ? std::abs(a) : 1);
    const double step = nice_ticks(a, b, 6).step;
    // What goes a little beyond zero, as strains do while a specimen is confined, does not cost a step of the axis.
    const double little = 0.05 * (b - a);
    if (a < 0 && a > -little) a -= 0.5 * little;
    else a = step * std::floor(a / step + 1e-9);
    if (b > 0 && b < little) b += 0.5 * little;
    else b = step * std::ceil(b / step - 1e-9);
    return {a, b, ticks_at(a, b, step)};
  }
};

/// Room for the longest label.
double label_width(const Ticks& ticks) {
  double most = 0;
  for (const std::string& l : ticks.label) most = std::max(most, text_width(l));
  return ChartLayout::label_size * most;
}

struct Box {
  double left, bottom, right, top;
  bool holds(const Point& p) const { return p.x() > left && p.x() < right && p.y() > bottom && p.y() < top; }
};

/// Whether a line or a bar comes into a box.
bool is_crossed(const Box& box, const Chart& chart, const ChartLayout& l) {
  for (const ChartLine& line : chart.lines) {
    const std::vector<Point> points = l.points_of(line);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point from = points[line.points || k == 0 ? k : k - 1], way = points[k] - from;
      const int steps = 1 + int(way.norm() / l.unit);
      for (int s = 0; s <= steps; ++s)
        if (box.holds(from + double(s) / steps * way)) return true;
    }
  }
  for (const ChartBar& bar : chart.bars)
    if (l.x_axis.along(bar.from, l.left, l.right) < box.right && l.x_axis.along(bar.to, l.left, l.right) > box.left &&
        l.left_axis.along(bar.height, l.bottom, l.top) > box.bottom)
      return true;
  return false;
}

/// In the first free corner; below the axes, on a longer sheet, when none is free.
void place_legend(const Chart& chart, ChartLayout& l) {
  const double u = l.unit;
  double widest = text_width(chart.bars_label);
  for (const ChartLine& line : chart.lines) widest = std::max(widest, text_width(line.label));
  const std::size_t entries = chart.legend_entries();
  if (entries == 0) {
    l.legend = {0, 0, 1, 0, false};
    return;
  }
  const double width = (ChartLayout::legend_symbol + 3.5 + ChartLayout::legend_size * widest) * u;
  const double depth = double(entries) * ChartLayout::legend_row * u, gap = 1.2 * u;
  for (const bool low : {false, true})
    for (const bool right : {false, true}) {
      const double x = right ? l.right - gap - width : l.left + gap, y = low ? l.bottom + gap + depth : l.top - gap;
      const bool fits = width < 0.6 * (l.right - l.left) && depth < 0.7 * (l.top - l.bottom);
      const Box box{x - gap, y - depth - gap, x + width + gap, y + gap};
      if (!fits || is_crossed(box, chart, l)) continue;
      l.legend = {x, y, 1, width, true};
      return;
    }
  const std::size_t fit = std::size_t((l.width - 4 * u) / width), one = 1;
  const std::size_t columns = std::clamp(fit, one, std::max(entries, one));
  const double more = (double((entries + columns - 1) / columns) * ChartLayout::legend_row + 1) * u;
  l.height += more;
  l.bottom += more;
  l.top += more;
  const double all = double(columns) * width;
  l.legend = {std::max(0.0, std::min(0.5 * (l.left + l.right - all), l.width - all)), more, columns, width, false};
}

}  // namespace

double text_width(const std::string& text) {
  return 0.64 * double(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<Point> ChartLayout::points_of(const ChartLine& line) const {
  std::vector<Point> points;
  for (std::size_t k = 0; k < line.x.size(); ++k)
    if (std::isfinite(line.x[k]) && std::isfinite(line.y[k])) points.push_back(at(line, k));
  return points;
}

ChartLayout layout_of(const Chart& chart, const Sheet& sheet) {
  Range x, left, right;
  for (const ChartLine& line : chart.lines) {
    BRECCIA_ASSERT(line.x.size() == line.y.size());
    x.include(line.x, line.y);
    (line.right_axis ? right : left).include(line.y, line.x);
  }
  for (const ChartBar& bar : chart.bars) {
    x.include({bar.from, bar.to}, {0, 0});
    left.include({0, bar.height}, {0, 0});
  }
  if (x.most < 2) throw UserError("there are fewer than two points to draw");
  if (chart.right_from_zero) {
    right.low = 0;
    right.high = std::max(right.high, 1.0);
  }
  ChartLayout l;
  l.width = sheet.size;  // a chart is wider than high
  l.height = sheet.size * 3 / 4;
  l.unit = l.height / 100;
  l.x_axis = x.rounded();
  l.left_axis = left.rounded();
  l.right_axis = right.rounded();
  l.left = (10 + label_width(l.left_axis.ticks)) * l.unit;
  l.right = l.width - (chart.right_title.empty() ? 5 : 10 + label_width(l.right_axis.ticks)) * l.unit;
  l.bottom = 14 * l.unit;
  const double above = chart.title.empty() ? 4 : 8;
  l.top = l.height - above * l.unit;
  if (chart.equal_scales) {
    const double wide = l.right - l.left, scale = wide / (l.x_axis.high - l.x_axis.low);
    // High enough for the title of its axis.
    l.left_axis.high = std::max(l.left_axis.high, l.left_axis.low + 45 * l.unit / scale);
    l.top = l.bottom + scale * (l.left_axis.high - l.left_axis.low);
    l.height = l.top + above * l.unit;
  }
  l.writing = writing_on(sheet.background);
  place_legend(chart, l);
  return l;
}

}  // namespace breccia::pictures
