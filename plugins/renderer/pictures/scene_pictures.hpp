// SPDX-License-Identifier: BSD-3-Clause
/// Pictures of the specimen and of its cracks.
#pragma once

#include <optional>

#include "results.hpp"
#include "style.hpp"

namespace breccia::pictures {

enum class Cut { none, quarter, half };

struct SpecimenPicture {
  std::string field;  ///< empty: `damage` if there is one, else the displacement
  ColourMap colours = ColourMap::automatic;
  std::optional<double> low, high;  ///< of the colour bar, in the SI unit of the field
  Cut cut = Cut::none;              ///< what is taken away on the reader's side
};
void draw_specimen(vtkPolyData* particles, const SpecimenPicture& picture, const Sheet& sheet,
                   const std::filesystem::path& file);

enum class CrackColour { mode, time };
void draw_cracks(vtkPolyData* bonds, CrackColour by, ColourMap colours, const Sheet& sheet,
                 const std::filesystem::path& file);

}  // namespace breccia::pictures
