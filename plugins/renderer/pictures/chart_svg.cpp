// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: vtkSVGExporter scales the pens of lines with the axes, so that curves vanish.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "canvas.hpp"
#include "chart.hpp"

namespace breccia::pictures {
namespace {

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", v + 0.0);
  return text;
}

std::string hex(const Rgb& c) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else out += c;
  }
  return out;
}

/// Draws in the layout's coordinates; SVG's y axis points down.
class Drawing {
 public:
  Drawing(std::ostream& out, const ChartLayout& layout) : out_(out), l_(layout) {}

  void line(double x1, double y1, double x2, double y2, double width, const Rgb& colour, bool dashed = false) {
    out_ << "<line x1=\"" << number(x1) << "\" y1=\"" << number(l_.height - y1) << "\" x2=\"" << number(x2)
         << "\" y2=\"" << number(l_.height - y2) << "\" " << stroke(width, colour, dashed) << "/>\n";
  }
  void circle(double x, double y, double radius, const Rgb& colour) {
    out_ << "<circle cx=\"" << number(x) << "\" cy=\"" << number(l_.height - y) << "\" r=\"" << number(radius)
         << "\" fill=\"" << hex(colour) << "\"/>\n";
  }
  /// `anchor` is start, middle or end; (x, y) the middle of the text's height.
  void text(double x, double y, double size, const char* anchor, const std::string& what, bool upright = false) {
    const std::string at = number(x) + " " + number(l_.height - y);
    out_ << "<text transform=\"translate(" << at << ")" << (upright ? " rotate(-90)" : "") << "\" y=\""
         << number(0.36 * size * l_.unit) << "\" font-size=\"" << number(size * l_.unit) << "\" text-anchor=\""
         << anchor << "\" fill=\"" << hex(l_.writing) << "\">" << escaped(what) << "</text>\n";
  }
  void curve(const ChartLine& line) {
    const ChartAxis& axis = line.right_axis ? l_.right_axis : l_.left_axis;
    std::string points;
    for (std::size_t k = 0; k < line.x.size(); ++k) {
      if (!std::isfinite(line.x[k]) || !std::isfinite(line.y[k])) continue;
      const double x = along(line.x[k], l_.x_axis, l_.left, l_.right), y = along(line.y[k], axis, l_.bottom, l_.top);
      if (line.points) circle(x, y, 0.5 * ChartLayout::marker * l_.unit, line.colour);
      else points += number(x) + "," + number(l_.height - y) + " ";
    }
    if (line.points) return;
    out_ << "<polyline fill=\"none\" stroke-linejoin=\"round\" " << stroke(pen(line), line.colour, line.dashed)
         << " points=\"" << points << "\"/>\n";
  }
  static double along(double value, const ChartAxis& axis, double from, double to) {
    return from + (value - axis.low) / (axis.high - axis.low) * (to - from);
  }
  static double pen(const ChartLine& line) { return line.dashed ? ChartLayout::dashed_line : ChartLayout::line; }

 private:
  std::string stroke(double width, const Rgb& colour, bool dashed) const {
    std::string s = "stroke=\"" + hex(colour) + "\" stroke-width=\"" + number(width * l_.unit) + "\"";
    if (dashed) s += " stroke-dasharray=\"" + number(1.2 * l_.unit) + " " + number(0.7 * l_.unit) + "\"";
    return s;
  }

  std::ostream& out_;
  const ChartLayout& l_;
};

void draw_axes(Drawing& d, const Chart& chart, const ChartLayout& l) {
  using L = ChartLayout;
  const double u = l.unit;
  for (const double at : l.x_axis.ticks.at) {
    const double x = Drawing::along(at, l.x_axis, l.left, l.right);
    d.line(x, l.bottom, x, l.top, L::grid_line, L::grid);
  }
  for (const double at : l.left_axis.ticks.at) {
    const double y = Drawing::along(at, l.left_axis, l.bottom, l.top);
    d.line(l.left, y, l.right, y, L::grid_line, L::grid);
  }
  d.line(l.left, l.bottom, l.right, l.bottom, L::axis_line, l.writing);
  d.line(l.left, l.bottom, l.left, l.top, L::axis_line, l.writing);
  for (std::size_t k = 0; k < l.x_axis.ticks.at.size(); ++k) {
    const double x = Drawing::along(l.x_axis.ticks.at[k], l.x_axis, l.left, l.right);
    d.line(x, l.bottom, x, l.bottom - L::tick * u, L::axis_line, l.writing);
    d.text(x, l.bottom - 3.4 * u, L::label_size, "middle", l.x_axis.ticks.label[k]);
  }
  const auto vertical = [&](const ChartAxis& axis, double x, double outward, const char* anchor) {
    for (std::size_t k = 0; k < axis.ticks.at.size(); ++k) {
      const double y = Drawing::along(axis.ticks.at[k], axis, l.bottom, l.top);
      d.line(x, y, x + outward * L::tick * u, y, L::axis_line, l.writing);
      d.text(x + outward * 1.9 * u, y, L::label_size, anchor, axis.ticks.label[k]);
    }
  };
  vertical(l.left_axis, l.left, -1, "end");
  const double middle_x = 0.5 * (l.left + l.right), middle_y = 0.5 * (l.bottom + l.top), offset = L::title_offset * u;
  d.text(middle_x, offset, L::title_size, "middle", chart.x_title);
  d.text(offset, middle_y, L::title_size, "middle", chart.left_title, true);
  if (chart.right_title.empty()) return;
  d.line(l.right, l.bottom, l.right, l.top, L::axis_line, l.writing);
  vertical(l.right_axis, l.right, 1, "start");
  d.text(l.width - offset, middle_y, L::title_size, "middle", chart.right_title, true);
}

void draw_legend(Drawing& d, const Chart& chart, const ChartLayout& l) {
  const double u = l.unit, x = l.left + 2 * u;
  double y = l.top - 2.4 * u;
  for (const ChartLine& line : chart.lines) {
    if (line.points) d.circle(x + 2.5 * u, y, 0.3 * ChartLayout::marker * u, line.colour);
    else d.line(x, y, x + 5 * u, y, Drawing::pen(line), line.colour, line.dashed);
    d.text(x + 6.5 * u, y, ChartLayout::legend_size, "start", line.label);
    y -= 4.1 * u;
  }
}

}  // namespace

void write_svg(const Chart& chart, const ChartLayout& l, const Sheet& sheet, const std::filesystem::path& file) {
  std::ofstream out(unfinished(file));
  Rgb paper;
  for (int k = 0; k < 3; ++k)
    paper[std::size_t(k)] = static_cast<unsigned char>(std::lround(255 * sheet.background[k]));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\""
      << number(l.width) << "\" height=\"" << number(l.height) << "\" viewBox=\"0 0 " << number(l.width) << " "
      << number(l.height) << "\" font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n<title>"
      << escaped(chart.left_title + " against " + chart.x_title)
      << "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"" << hex(paper) << "\"/>\n";
  Drawing drawing(out, l);
  draw_axes(drawing, chart, l);
  for (const ChartLine& line : chart.lines) drawing.curve(line);
  draw_legend(drawing, chart, l);
  out << "</svg>\n";
  out.close();
  if (!out) cannot_write(file, "the disk is full or the folder cannot be written");
  give_final_name(file);
}

}  // namespace breccia::pictures
