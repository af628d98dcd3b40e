// SPDX-License-Identifier: BSD-3-Clause
// Written by hand: vtkSVGExporter scales the pens of lines with the axes, so that curves vanish.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "breccia/atomic_file.hpp"
#include "breccia/utf8.hpp"
#include "painter.hpp"

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
  for (const char c : valid_utf8(text)) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c >= 0 && c < ' ') out += ' ';  // XML knows no control characters
    else out += c;
  }
  return out;
}

/// SVG's y axis points down.
class SvgPainter final : public Painter {
 public:
  SvgPainter(std::ostream& out, double height) : out_(out), height_(height) {}

  void polyline(const std::vector<Point>& points, const Stroke& stroke) override {
    if (points.size() == 2) {
      out_ << "<line x1=\"" << number(points[0].x()) << "\" y1=\"" << number(height_ - points[0].y()) << "\" x2=\""
           << number(points[1].x()) << "\" y2=\"" << number(height_ - points[1].y()) << "\" ";
      pen(stroke);
      out_ << "/>\n";
      return;
    }
    out_ << "<polyline fill=\"none\" stroke-linejoin=\"round\" ";
    pen(stroke);
    out_ << " points=\"" << list(points) << "\"/>\n";
  }
  void polygon(const std::vector<Point>& corners, const Rgb& fill) override {
    out_ << "<polygon fill=\"" << hex(fill) << "\" points=\"" << list(corners) << "\"/>\n";
  }
  void disc(const Point& centre, double radius, const Rgb& fill) override {
    out_ << "<circle cx=\"" << number(centre.x()) << "\" cy=\"" << number(height_ - centre.y()) << "\" r=\""
         << number(radius) << "\" fill=\"" << hex(fill) << "\"/>\n";
  }
  void text(const Point& at, double size, Anchor anchor, const std::string& what, const Rgb& colour,
            bool upright) override {
    constexpr const char* names[] = {"start", "middle", "end"};
    out_ << "<text transform=\"translate(" << number(at.x()) << " " << number(height_ - at.y()) << ")"
         << (upright ? " rotate(-90)" : "") << "\" y=\"" << number(middle_of_type * size) << "\" font-size=\""
         << number(size) << "\" text-anchor=\"" << names[int(anchor)] << "\" fill=\"" << hex(colour) << "\">"
         << escaped(what) << "</text>\n";
  }

 private:
  void pen(const Stroke& stroke) {
    out_ << "stroke=\"" << hex(stroke.colour) << "\" stroke-width=\"" << number(stroke.width) << "\"";
    if (stroke.dashes.empty()) return;
    out_ << " stroke-dasharray=\"";
    for (std::size_t k = 0; k < stroke.dashes.size(); ++k) out_ << (k ? " " : "") << number(stroke.dashes[k]);
    out_ << "\"";
  }
  std::string list(const std::vector<Point>& points) const {
    std::string text;
    for (const Point& p : points) text += number(p.x()) + "," + number(height_ - p.y()) + " ";
    return text;
  }
  std::ostream& out_;
  double height_;
};

}  // namespace

void write_svg(const Page& page, const Draw& draw, const std::filesystem::path& file) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << page.width
      << "\" height=\"" << page.height << "\" viewBox=\"0 0 " << page.width << " " << page.height
      << "\" font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n<title>" << escaped(page.title)
      << "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"" << hex(bytes_of(page.background)) << "\"/>\n";
  SvgPainter painter(out, page.height);
  draw(painter);
  out << "</svg>\n";
  write_file(file, std::move(out).str());
}

}  // namespace breccia::pictures
