// SPDX-License-Identifier: BSD-3-Clause
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include "../frame_pieces.hpp"
#include "breccia/text_file.hpp"
#include "spheres.hpp"

namespace breccia::sphere_file {

Spheres read_vtp(const std::filesystem::path& file) {
  (void)read_bytes(file, 1);  // its words for a file that is not there or may not be read
  const vtkSmartPointer<vtkPolyData> data = vtk::read_frame(file);
  if (!data) throw UserError("cannot read the packing file " + file.string() + ": it is damaged, or no VTK poly data");

  vtkDataArray* radius = data->GetPointData()->GetArray("radius");
  Spheres spheres;
  auto* outline = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("specimen_outline"));
  if (outline && outline->GetNumberOfValues() == 1) spheres.outline = outline->GetValue(0);
  if (vtkDataArray* cell = data->GetFieldData()->GetArray("cell_vectors");
      cell && cell->GetNumberOfTuples() == 3 && cell->GetNumberOfComponents() == 3)
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) spheres.cell(c, k) = cell->GetComponent(k, c);
  const vtkIdType n = data->GetNumberOfPoints();
  if (n > 0 && (!radius || radius->GetNumberOfComponents() != 1))
    throw UserError(file.string() + " has no point array `radius` with one number for each point");
  for (vtkIdType k = 0; k < n; ++k) {
    double x[3];
    data->GetPoint(k, x);
    spheres.position.emplace_back(x[0], x[1], x[2]);
    spheres.radius.push_back(radius->GetTuple1(k));
  }
  return spheres;
}

std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& file) { return vtk::pieces_of(file); }

}  // namespace breccia::sphere_file
