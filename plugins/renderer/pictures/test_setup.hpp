// SPDX-License-Identifier: BSD-3-Clause
/// What the files of a run say of how its specimen was loaded: platens, held and loaded particles, and from where such
/// a test is best seen. It follows from where walls and forces are, never from the name of a test.
#pragma once

#include "results.hpp"
#include "spheres.hpp"

namespace breccia::pictures {

/// A plane that presses on the specimen, or that its held end is glued to.
struct Platen {
  Vec3 point, normal;  ///< [m], unit vector toward the specimen
};

/// What a group of particles next to each other is loaded with.
struct DeadLoad {
  Vec3 tip;        ///< where it meets the specimen's surface [m]
  Vec3 direction;  ///< unit vector
};

struct TestSetup {
  int dimension = 3;
  std::optional<SpecimenShape> specimen;
  std::vector<Platen> platens;
  std::vector<DeadLoad> loads;
  std::vector<std::uint8_t> held;   ///< of each particle, where dead loads act on others; else empty
  Vec3 load = Vec3::Zero();         ///< unit vector of the load; zero: the files do not say
  Vec3 across = Vec3::Zero();       ///< along which the motion tells most: across a crack that is to come, or a beam
  Vec3 face = -Vec3::UnitY();       ///< toward the reader, in the view that is square to the plane of the load
  Vec3 up = Vec3::UnitZ();          ///< upward in that view
  bool best_from_the_face = false;  ///< a disc, a tension test or a beam: other views hide what matters
  bool splits = false;              ///< a disc between platens, which may roll

  /// The largest extent of the specimen that is seen [m].
  double size() const {
    return !specimen ? 0 : dimension == 2 ? specimen->extent.head<2>().maxCoeff() : specimen->extent.maxCoeff();
  }
};

/// Whether each particle is held.
std::vector<std::uint8_t> held_of(vtkPolyData* particles);
/// Whether dead loads acted on particles before, and do no more.
bool was_released(vtkPolyData* particles);

/// Each of the frames may be missing.
TestSetup setup_of(vtkPolyData* particles, vtkPolyData* bonds, vtkPolyData* walls);

}  // namespace breccia::pictures
