// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "breccia/text_file.hpp"
#include "spheres.hpp"

namespace breccia::from_file {

Spheres read_vtp(const std::filesystem::path& file) {
  // Whatever VTK dislikes ends here; without observers it would print.
  bool bad = false;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&bad);
  note->SetCallback([](vtkObject*, unsigned long, void* client, void*) { *static_cast<bool*>(client) = true; });
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, note);
  reader->SetParserErrorObserver(note);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
  (void)read_bytes(file, 1);  // its words for a file that is not there or may not be read
  if (reader->CanReadFile(file.c_str())) {
    reader->SetFileName(file.c_str());
    reader->Update();
  } else {
    bad = true;
  }
  if (bad || reader->GetErrorCode() != 0)
    throw UserError("cannot read the packing file " + file.string() + ": it is damaged, or no VTK poly data");

  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* radius = data->GetPointData()->GetArray("radius");
  Spheres spheres;
  auto* outline = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("specimen_outline"));
  if (outline && outline->GetNumberOfValues() == 1) spheres.outline = outline->GetValue(0);
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

}  // namespace breccia::from_file
