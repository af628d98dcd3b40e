// SPDX-License-Identifier: BSD-3-Clause
/// A file of spheres as a workflow names it, for the packings that read one.
#pragma once

#include <optional>

#include "breccia/packing.hpp"
#include "breccia/text_file.hpp"
#include "spheres.hpp"

namespace breccia::sphere_file {

enum class LengthUnit { metre, centimetre, millimetre, micrometre, inch };

struct Source {
  std::filesystem::path file;
  std::optional<LengthUnit> length_unit;
  std::optional<std::vector<double>> period;  // [m]
};

/// What of a file's form they all tell in their details.
inline constexpr const char* form_of_files =
    "CSV: the first line names the columns `x`, `y`, `z` and `radius` in any order, separated by commas, semicolons or "
    "tabs; `#` starts a comment; other columns of numbers are kept for `material_of`. VTP: points in metres and a "
    "point array `radius` in metres, such as a frame of the output `vtk`, or a PVTP file that joins such. In two "
    "dimensions z is zero, and the column may be "
    "missing.";

void check(const Source& source, Issues& issues);

/// Declares its parameters, for a configuration that inherits them.
template <class Config>
void describe(Schema<Config>& s) {
  s.param("file", &Source::file).example("specimen.csv").doc("the .csv, .vtp or .pvtp file");
  s.param("length_unit", &Source::length_unit)
      .choice("m", LengthUnit::metre, "metre")
      .choice("cm", LengthUnit::centimetre, "centimetre")
      .choice("mm", LengthUnit::millimetre, "millimetre")
      .choice("um", LengthUnit::micrometre, "micrometre")
      .choice("in", LengthUnit::inch, "inch, 25.4 mm")
      .doc("of all columns of a .csv file; a .vtp file is always in metres")
      .example("mm");
  s.param("period", &Source::period)
      .unit("m")
      .items(2, 3)
      .at_least(0)
      .example("[50 mm, 50 mm, 100 mm]")
      .doc(
          "after which length the particles repeat themselves along x, y, z; 0 where they do not. A frame of a run "
          "with `periodic` says so itself");
  s.check([](const Config& c, Issues& issues) { check(c, issues); });
}

/// Whether it is one of VTK's, which say themselves what they hold.
inline bool is_vtk(const std::filesystem::path& file) { return has_ending(file, ".vtp") || has_ending(file, ".pvtp"); }
/// The file, and those that it joins.
std::vector<std::filesystem::path> inputs(const Source& source);

/// Whether ranks can read it together, each its share.
bool has_shares(const Source& source);

/// UserError with the line for what is no sphere. All of it, or the share that is asked for.
Spheres read(const Source& source, const PackingRequest& request);

/// After which lengths they repeat themselves, as `period` says or else the file; 0 where they do not [m].
Vec3 period_of(const Source& source, const Spheres& spheres);

/// UserError for spheres that cannot be reckoned with in this space, or two in one place. Two in different shares are
/// left to the engine, which looks at all pairs.
void refuse_bad(const Source& source, const Spheres& spheres, const Space& space, const SeenInPart& share);

}  // namespace breccia::sphere_file
