// SPDX-License-Identifier: BSD-3-Clause
/// Views of the simulation as VTK poly data: particles and cracks as vertices, bonds as lines, walls as
/// quads.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia::vtk_output {

enum class Precision { single_precision, double_precision };

/// Corners of a box around the particles, surfaces included [m].
struct Bounds {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  void archive(Archive& archive) {
    archive("low", low);
    archive("high", high);
  }
};
Bounds bounds_of(const SimulationView& view);

/// Centres and radii are always written in double precision: a frame can serve as a packing without loss.
/// Of a part what counts in it. A field of the wrong length, or one whose name is taken, is a UserError.
vtkSmartPointer<vtkPolyData> particle_data(const SimulationView& view, std::span<const Field> fields,
                                           Precision precision);
/// `piece`: with what is needed to join the lines of several pieces.
vtkSmartPointer<vtkPolyData> bond_data(const SimulationView& view, std::span<const Field> fields, Precision precision,
                                       bool piece);
/// What broke so far, each crack as the point between the two particles: in the order in which they came.
vtkSmartPointer<vtkPolyData> crack_data(const SimulationView& view, Precision precision);
/// Each wall as a square a little larger than `specimen`.
vtkSmartPointer<vtkPolyData> wall_data(const SimulationView& view, const Bounds& specimen);

}  // namespace breccia::vtk_output
