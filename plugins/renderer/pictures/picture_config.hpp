// SPDX-License-Identifier: BSD-3-Clause
/// What a user can say of one picture.
#pragma once

#include "movie.hpp"
#include "scene_pictures.hpp"

namespace breccia::pictures {

enum class Motif {
  specimen,
  cutaway,
  cracks,
  cracks_time,
  displacement,
  displacement_across,
  stress_strain,
  load_curve,
  strains,
  tables,
  histogram
};

enum class FieldPart { x, y, z, xx, yy, zz, xy, yz, xz, yx, zy, zx, magnitude, mean, von_mises };

struct PictureConfig : SceneOptions {
  Motif show = Motif::specimen;
  std::optional<std::string> name, field;
  std::optional<FieldPart> component;
  ColourMap colour_map = ColourMap::automatic;
  std::optional<double> low, high;
  std::optional<long> frame, bins;
  std::optional<Cut> cut;
  std::optional<MovieFormat> movie;
  std::optional<double> frames_per_second;

  static void describe(Schema<PictureConfig>& s);
  /// What ranges cannot say; `path` is where the picture stands in the workflow.
  void check(const std::string& path, Issues& issues) const;

  std::string file_name() const;
  /// The field's name with that of the component, as files' readers know it; empty where nothing is said.
  std::string shown_field() const;
  bool is_scene() const { return show <= Motif::displacement_across; }
  SceneWish wish() const;
};

}  // namespace breccia::pictures
