// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `renderer`: makes pictures from the files of a finished run. It never sees the simulation.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"

namespace breccia {

struct RenderRequest {
  std::filesystem::path source;     ///< a result folder, or one .pvd, .vtp or .pvtp file
  std::filesystem::path directory;  ///< where the pictures go
};

/// Finished runs to be shown in one picture.
struct ComparisonRequest {
  struct Run {
    std::filesystem::path folder;
    std::string label;
  };
  std::vector<Run> runs;            ///< in the order of the legend
  std::filesystem::path directory;  ///< where the pictures go
};

/// One chart of a parameter study: a measured quantity over another or over a parameter.
struct StudyChart {
  struct Axis {
    std::string title;  ///< "tension shape", without the unit
    std::string unit;   ///< SI; "1" for a pure number
  };
  struct Series {
    std::string label;         ///< empty when it is the only one
    std::vector<double> x, y;  ///< SI, equally many; what is not finite is not drawn
    bool joined;               ///< by a line, in their order; else points only
  };
  Axis x, y;
  std::vector<Series> series;  ///< in the order of the legend
  std::filesystem::path file;  ///< of the picture, without an ending
};

class BRECCIA_API Renderer : public Plugin {
 public:
  static constexpr const char* kind = "renderer";
  /// The files it made. `Unavailable` when this machine cannot draw; UserError when the source is not usable.
  virtual std::vector<std::filesystem::path> render(const RenderRequest& request, Host& host) = 0;
  /// The same for several runs together.
  virtual std::vector<std::filesystem::path> compare(const ComparisonRequest&, Host&) {
    throw Unavailable("this renderer draws no comparisons");
  }
  /// A chart of a parameter study. UserError when there is too little to draw.
  virtual std::vector<std::filesystem::path> chart(const StudyChart&, Host&) {
    throw Unavailable("this renderer draws no charts of studies");
  }
};

}  // namespace breccia
