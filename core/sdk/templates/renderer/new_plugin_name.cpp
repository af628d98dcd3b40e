// SPDX-License-Identifier: BSD-3-Clause
/// One curve of a finished run over another, as an SVG picture.
/// Sources: name what the picture follows here; README.md says more.
#include <cmath>
#include <cstdio>

#include "breccia/atomic_file.hpp"
#include "breccia/renderer.hpp"
#include "breccia/result_tools/table_file.hpp"

class NewPluginName final : public breccia::Renderer {
 public:
  /// What the workflow says, in SI units and within its range when it comes here.
  struct Config {
    std::string x, y;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("One curve of a run over another, as SVG")
        .source("say what the picture follows")
        .details(
            "Writes `new_plugin_name.svg`. It reads files and never sees the simulation: `breccia render` makes the "
            "same picture.");
    s.param("x", &Config::x).fallback("platen_strain").doc("column of curves.csv along the horizontal axis");
    s.param("y", &Config::y).fallback("platen_stress_Pa").doc("column of curves.csv along the vertical axis");
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  /// Returns the files it made. UserError when the source is of no use; `breccia::Unavailable` when this machine
  /// cannot draw. Either leaves the run whole. A renderer that can put runs side by side overrides `compare`, too.
  std::vector<std::filesystem::path> render(const breccia::RenderRequest& request, breccia::Host&) override {
    if (!std::filesystem::is_directory(request.source))
      throw breccia::UserError("renderer new_plugin_name: " + request.source.string() + " is not a folder of results");
    const breccia::TableFile curves(request.source / "curves.csv");
    const std::vector<double>&x = curves.column(config_.x), &y = curves.column(config_.y);
    const Range across = range(x), up = range(y);

    std::string points;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (std::isfinite(x[k]) && std::isfinite(y[k]))  // empty cells were not measured
        points += text("%.2f,%.2f ", left + width * across.share(x[k]), top + height * (1 - up.share(y[k])));
    std::string svg = text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\">\n", left + width + 20,
                           top + height + 60);
    svg += text("<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"black\"/>\n", left, top,
                width, height);
    svg += "<polyline fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\" points=\"" + points + "\"/>\n";
    svg += label(left, top + height + 20, "start", text("%.4g", across.low));
    svg += label(left + width, top + height + 20, "end", text("%.4g", across.high));
    svg += label(left + width / 2, top + height + 40, "middle", config_.x);
    svg += label(left - 8, top + height, "end", text("%.4g", up.low));
    svg += label(left - 8, top + 12, "end", text("%.4g", up.high));
    svg += label(left, top - 12, "start", config_.y);
    svg += "</svg>\n";

    const std::filesystem::path file = request.directory / "new_plugin_name.svg";
    breccia::write_file(file, svg);
    return {file};
  }

 private:
  static constexpr double left = 110, top = 40, width = 480, height = 320;  // pixels

  struct Range {
    double low, high;
    double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
  };
  static Range range(const std::vector<double>& values) {
    Range r{INFINITY, -INFINITY};
    for (const double v : values)
      if (std::isfinite(v)) r = {std::min(r.low, v), std::max(r.high, v)};
    if (!(r.low <= r.high)) throw breccia::UserError("renderer new_plugin_name: there is nothing to draw");
    return r;
  }
  template <class... T>
  static std::string text(const char* format, T... values) {
    char line[200];
    std::snprintf(line, sizeof line, format, values...);
    return line;
  }
  static std::string label(double x, double y, const char* anchor, const std::string& words) {
    std::string safe;
    for (const char c : words) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return text("<text x=\"%g\" y=\"%g\" text-anchor=\"%s\" font-family=\"sans-serif\" font-size=\"13\">", x, y,
                anchor) +
           safe + "</text>\n";
  }

  Config config_;
};

BRECCIA_PLUGIN(NewPluginName, "renderer", "new_plugin_name")
