// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of the specimen and of its cracks.
#pragma once

#include "camera.hpp"
#include "colours.hpp"
#include "cracks.hpp"

namespace breccia::pictures {

/// What was written of one instant; particles or bonds may be missing.
struct SceneFrame {
  vtkSmartPointer<vtkPolyData> particles, bonds, walls;
  TestSetup setup;
};

enum class Cut { none, automatic, quarter, half };
enum class CrackColour { mode, time };

struct SceneWish {
  bool cracks = false;  ///< the picture is of the cracks, else of the particles
  CrackColour crack_colour = CrackColour::mode;
  std::string field;    ///< of the particles; empty: `damage` if there is some, else the displacement
  bool across = false;  ///< instead of a field the displacement along `TestSetup::across`
  ColourWish colours;
  Cut cut = Cut::none;  ///< what is taken away on the reader's side
  SceneOptions options;

  /// Whether the cracks behind the particles are seen.
  bool sees_through() const { return options.opacity.value_or(1) < 1; }
};

/// What stays the same over the frames of a movie: taken from the first frame that is drawn, unless it is there.
struct SceneFixed {
  std::optional<double> slab;  ///< share of the specimen that cracks are shown of; 1: all of it
  std::optional<Viewpoint> view;
  std::optional<Scale> scale;
  std::optional<CrackScale> crack_scale;
};
/// Fixes them without drawing.
void fix_scene(const SceneFrame& frame, const SceneWish& wish, const Sheet& sheet, SceneFixed& fixed);
/// So that the values of this frame have their colours, too.
void widen_scale(const SceneFrame& frame, const SceneWish& wish, SceneFixed& fixed);

struct ScenePicture {
  Image image;
  Overlay overlay;
};
ScenePicture draw_scene(const SceneFrame& frame, const SceneWish& wish, const Sheet& sheet, SceneFixed& fixed);

/// The values that the particles of a frame are coloured by, of those that are seen.
Values colour_values(const SceneFrame& frame, const SceneWish& wish);

void write_scene(const ScenePicture& picture, const Sheet& sheet, const std::filesystem::path& file);
/// The same as an image, for a movie.
Image flat_scene(const ScenePicture& picture, const Sheet& sheet);

}  // namespace breccia::pictures
