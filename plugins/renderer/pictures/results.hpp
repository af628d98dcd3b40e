// SPDX-License-Identifier: BSD-3-Clause
/// The files of a finished run, as a renderer finds them.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/views.hpp"

namespace breccia::pictures {

/// What a source offers; each is empty when it has none.
struct RunResults {
  std::vector<std::filesystem::path> particle_frames, bond_frames, wall_frames;
  std::filesystem::path curves;
  std::vector<std::filesystem::path> tables;  ///< by name
};

/// `source` is a result folder, or one .pvd, .vtp or .pvtp file of particles or bonds. UserError when it is none of
/// these.
RunResults find_results(const std::filesystem::path& source);

/// UserError, naming the file, when it is missing or damaged.
vtkSmartPointer<vtkPolyData> read_frame(const std::filesystem::path& file);

/// What a frame says of itself, in SI; empty where it says nothing.
struct FrameFacts {
  std::optional<double> time;
  int dimension = 3;
  std::optional<SpecimenShape> specimen;
  std::vector<std::string> materials;  ///< names of the values of the array `material`
};
FrameFacts facts_of(vtkPolyData* frame);

/// One number per particle (or bond): an array of numbers, a component of vectors or tensors ("velocity_z",
/// "stress_zz"), or `_magnitude`, and of tensors `_mean`, `_von_mises`; of an array alone its magnitude. In two
/// dimensions the mean of a tensor is that of the plane. UserError, with what there is, when there is no such field or
/// component.
struct Values {
  std::vector<double> value;
  std::string name, unit;
  bool whole = false;  ///< counts and numbers of things
};
Values field_of(vtkFieldData* data, const std::string& name, int dimension = 3);
bool has_field(vtkFieldData* data, const std::string& name);

}  // namespace breccia::pictures
