// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.hpp"

#include <algorithm>
#include <cmath>

namespace breccia::pictures {
namespace {

using Anchor = Painter::Anchor;
constexpr double type_size = 1.9, title_size = 2.1, small_size = 1.7;  // in hundredths of the height

}  // namespace

void Overlay::line(Painter& painter, double x1, double y1, double x2, double y2, double thickness) const {
  painter.line({x1, y1}, {x2, y2}, {colour, thickness * unit, {}});
}

void Overlay::paint(Painter& painter) const {
  const double u = unit;
  if (bar) paint_bar(painter);
  if (!legend.empty()) paint_legend(painter);
  if (scale_bar > 0) paint_scale(painter);
  if (!directions.empty()) paint_directions(painter);
  for (std::size_t k = 0; k < captions.size(); ++k)
    painter.text({width - 3 * u, (k == 0 ? 3.6 : 4.8 + 2.6 * double(k)) * u}, type_size * u, Anchor::end, captions[k],
                 colour);
  if (!title.empty()) painter.text({0.5 * width, height - 4 * u}, 1.15 * title_size * u, Anchor::middle, title, colour);
  for (const auto& [from, to] : arrows) paint_arrow(painter, from, to);
}

void Overlay::paint_arrow(Painter& painter, const Point& from, const Point& to) const {
  const Point way = to - from;
  if (!(way.norm() > 2 * unit)) return;  // points at the reader
  const Point along = way.normalized(), across(-along.y(), along.x()), neck = to - 2.2 * unit * along;
  painter.line(from, neck, {colour, 0.55 * unit, {}});
  painter.polygon({to, neck + 0.95 * unit * across, neck - 0.95 * unit * across}, colour);
}

void Overlay::paint_bar(Painter& painter) const {
  const double u = unit, x = width - (100 * share_of_bar - 7) * u, w = 2.4 * u, h = std::min(50 * u, height - 27 * u),
               y = 0.5 * (height - h);
  const std::size_t steps = bar->colours.step.size();
  for (std::size_t k = 0; k < steps; ++k) {
    // Each step overlaps the next, which is drawn over it: no seams.
    const double low = y + h * double(k) / double(steps), high = y + h * double(std::min(k + 2, steps)) / double(steps);
    painter.polygon({{x, low}, {x + w, low}, {x + w, high}, {x, high}}, bar->colours.step[k]);
  }
  painter.polyline({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}, {x, y}}, {colour, 0.12 * u, {}});
  for (std::size_t k = 0; k < bar->ticks.at.size(); ++k) {
    const double at = y + h * (bar->ticks.at[k] - bar->low) / (bar->high - bar->low);
    line(painter, x + w, at, x + w + 0.7 * u, at, 0.14);
    painter.text({x + w + 1.2 * u, at}, type_size * u, Anchor::start, bar->ticks.label[k], colour);
  }
  painter.text({x - 2.4 * u, y + h / 2}, title_size * u, Anchor::middle, bar->title, colour, true);
}

void Overlay::paint_legend(Painter& painter) const {
  const double u = unit, x = width - (100 * share_of_bar - 1) * u, side = 2 * u;
  double y = height - (title.empty() ? 7 : 10) * u;
  for (const LegendEntry& e : legend) {
    painter.disc({x + side / 2, y}, side / 2, e.colour);
    painter.text({x + 1.5 * side, y}, type_size * u, Anchor::start, e.text, colour);
    y -= 3.4 * u;
  }
}

void Overlay::paint_scale(Painter& painter) const {
  const double u = unit, x = 12 * u, y = 3.4 * u;
  line(painter, x, y, x + scale_bar, y, 0.3);
  line(painter, x, y - 0.6 * u, x, y + 0.6 * u, 0.2);
  line(painter, x + scale_bar, y - 0.6 * u, x + scale_bar, y + 0.6 * u, 0.2);
  painter.text({x + scale_bar / 2, y + 1.9 * u}, type_size * u, Anchor::middle, scale_text, colour);
}

void Overlay::paint_directions(Painter& painter) const {
  const double u = unit, length = 3.4 * u;
  double left = 0, down = 0;  // how far they reach to where the sheet ends
  for (const auto& [d, name] : directions) {
    left = std::max(left, -d.x());
    down = std::max(down, -d.y());
  }
  const double x = std::max(5.0, 2.5 + 4.6 * left) * u, y = std::max(4.5, 2.0 + 4.6 * down) * u;
  for (const auto& [d, name] : directions) {
    if (d.norm() < 0.15) continue;  // points at the reader
    line(painter, x, y, x + length * d.x(), y + length * d.y(), 0.2);
    const Eigen::Vector2d at = length * d + 1.2 * u * d.normalized();
    painter.text({x + at.x(), y + at.y()}, small_size * u, Anchor::middle, name, colour);
  }
}

}  // namespace breccia::pictures
