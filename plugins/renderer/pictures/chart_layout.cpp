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
    if (!(b > a)) b = a + (a != 0 ? std::abs(a) : 1);
    const double step = nice_ticks(a, b, 6).step;
    a = step * std::floor(a / step + 1e-9);
    b = step * std::ceil(b / step - 1e-9);
    return {a, b, ticks_at(a, b, step)};
  }
};

/// Room for the longest label; digits of DejaVu Sans are 0.64 of the type size wide.
double label_width(const Ticks& ticks) {
  std::size_t longest = 0;
  for (const std::string& l : ticks.label)  // the minus sign has three bytes
    longest =
        std::max(longest, std::size_t(std::count_if(l.begin(), l.end(), [](char c) { return (c & 0xC0) != 0x80; })));
  return 0.64 * ChartLayout::label_size * double(longest);
}

}  // namespace

ChartLayout layout_of(const Chart& chart, const Sheet& sheet) {
  Range x, left, right;
  for (const ChartLine& line : chart.lines) {
    BRECCIA_ASSERT(line.x.size() == line.y.size());
    x.include(line.x, line.y);
    (line.right_axis ? right : left).include(line.y, line.x);
  }
  if (x.most < 2) throw UserError("there are fewer than two points to draw");
  if (chart.right_from_zero) { right.low = 0; right.high = std::max(right.high, 1.0); }
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
  l.top = l.height - 4 * l.unit;
  l.writing = writing_on(sheet.background);
  return l;
}

}  // namespace breccia::pictures
