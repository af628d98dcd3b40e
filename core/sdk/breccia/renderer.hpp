// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `renderer`: makes pictures from the files of a finished run. It never sees the simulation.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"

namespace breccia {

struct RenderRequest {
  std::filesystem::path source;     ///< a result folder, or one .pvd or .vtp file
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

class BRECCIA_API Renderer : public Plugin {
 public:
  static constexpr const char* kind = "renderer";
  /// The files it made. `Unavailable` when this machine cannot draw; UserError when the source is not usable.
  virtual std::vector<std::filesystem::path> render(const RenderRequest& request, Host& host) = 0;
  /// The same for several runs together.
  virtual std::vector<std::filesystem::path> compare(const ComparisonRequest&, Host&) {
    throw Unavailable("this renderer draws no comparisons");
  }
};

}  // namespace breccia
