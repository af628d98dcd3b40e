// SPDX-License-Identifier: BSD-3-Clause
/// The frames of a run as scenes.
#pragma once

#include "scene_pictures.hpp"

namespace breccia::pictures {

/// Reads each file once as long as the same frame is asked for, and the test's setup once: from the last frame, since
/// the first one does not show yet what was pulled where.
class Frames {
 public:
  explicit Frames(const RunResults& results) : results_(results) {}

  /// How many there are of what a picture shows.
  std::size_t count(bool cracks) const {
    return cracks ? results_.bond_frames.size() : results_.particle_frames.size();
  }
  /// `index`: the last if absent. Particles for pictures of particles and bonds for those of cracks must be readable;
  /// UserError when there is no such frame.
  SceneFrame at(std::optional<long> index, bool cracks, bool with_bonds);
  const TestSetup& setup();

 private:
  struct Kept {
    std::filesystem::path file;
    vtkSmartPointer<vtkPolyData> frame;
  };
  static vtkSmartPointer<vtkPolyData> read(const std::vector<std::filesystem::path>& files, std::size_t at, Kept& kept);
  static vtkSmartPointer<vtkPolyData> try_to_read(const std::vector<std::filesystem::path>& files, std::size_t at,
                                                  Kept& kept);

  const RunResults& results_;
  Kept particles_, bonds_, walls_;
  std::optional<TestSetup> setup_;
};

}  // namespace breccia::pictures
