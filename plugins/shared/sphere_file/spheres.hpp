// SPDX-License-Identifier: BSD-3-Clause
/// Spheres as a file states them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "breccia/packing.hpp"

namespace breccia::sphere_file {

struct Spheres {
  std::vector<Vec3> position;     ///< [m]
  std::vector<double> radius;     ///< [m]
  std::vector<std::size_t> line;  ///< of the text file; empty when there are no lines to point at
  /// Other columns of numbers, one value a sphere, and the names of those that hold something else.
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  std::vector<std::string> ignored;
  std::string outline;       ///< "cylinder", "box", ... when the file says what its specimen is; else empty
  Mat3 cell = Mat3::Zero();  ///< columns: by which vectors space repeated itself, when the file says so [m]

  /// "packing.csv, line 12" or "packing.vtp, point 10".
  std::string where(const std::filesystem::path& file, std::size_t k) const {
    return file.string() + (line.empty() ? ", point " + std::to_string(k) : ", line " + std::to_string(line[k]));
  }
};

/// A table with the columns x, y, z and radius in any order, all in one unit of length of `unit` metres. Without
/// `needs_z` the column z may be missing. UserError with the line number for what is not a number. The lines of the
/// share that is asked for; all shares are read together.
Spheres read_csv(const std::filesystem::path& file, double unit, bool needs_z, const PackingRequest& request);

/// Points in metres with the point array `radius` in metres: a frame of the output `vtk`, for example, which also says
/// what the specimen was and how it repeated itself.
Spheres read_vtp(const std::filesystem::path& file);
/// Of a .pvtp file the files that it joins.
std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& file);

}  // namespace breccia::sphere_file
