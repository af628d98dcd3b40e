// SPDX-License-Identifier: BSD-3-Clause
/// Frames as the output `vtk` writes them: one file, or pieces of several ranks.
#pragma once

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLUtilities.h>

#include <map>
#include <vector>

#include "checked_vtp_reader.hpp"

namespace breccia::vtk {

/// The rows of `from` named behind those that are there. False where the arrays are others.
inline bool append_rows(vtkFieldData* from, const std::vector<vtkIdType>& rows, vtkFieldData* to) {
  for (int k = 0; k < to->GetNumberOfArrays(); ++k) {
    vtkAbstractArray *const into = to->GetAbstractArray(k), *const of = from->GetAbstractArray(into->GetName());
    if (!of || of->GetDataType() != into->GetDataType() || of->GetNumberOfComponents() != into->GetNumberOfComponents())
      return false;
    for (const vtkIdType row : rows) into->InsertNextTuple(row, of);
  }
  return true;
}

/// Empty arrays like those.
inline void take_arrays(vtkFieldData* of, vtkFieldData* to) {
  for (int k = 0; k < of->GetNumberOfArrays(); ++k) {
    vtkAbstractArray* const known = of->GetAbstractArray(k);
    const auto array = vtkSmartPointer<vtkAbstractArray>::Take(known->NewInstance());
    array->SetName(known->GetName());
    array->SetNumberOfComponents(known->GetNumberOfComponents());
    array->CopyComponentNames(known);
    array->CopyInformation(known->GetInformation());
    to->AddArray(array);
  }
}

/// What the pieces hold, one after the other, as one file would: points that stand in them as copies of those of others
/// (`vtkGhostType`) once, images of points behind them. Null when they do not fit together.
inline vtkSmartPointer<vtkPolyData> joined(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) {
  if (pieces.empty()) return nullptr;
  auto whole = vtkSmartPointer<vtkPolyData>::New();
  take_arrays(pieces.front()->GetPointData(), whole->GetPointData());
  take_arrays(pieces.front()->GetCellData(), whole->GetCellData());
  whole->GetFieldData()->DeepCopy(pieces.front()->GetFieldData());
  whole->GetPointData()->RemoveArray("vtkGhostType");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<std::vector<vtkIdType>> place(pieces.size());  // of each point of each piece
  std::map<vtkIdType, vtkIdType> of_id;
  const auto ghost = [](vtkPolyData* piece) {
    return vtkUnsignedCharArray::SafeDownCast(piece->GetPointData()->GetArray("vtkGhostType"));
  };
  const auto id = [](vtkPolyData* piece) { return piece->GetPointData()->GetArray("id"); };
  for (const bool images : {false, true})
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      vtkPolyData* const piece = pieces[p];
      vtkUnsignedCharArray* const copied = ghost(piece);
      vtkDataArray* const ids = id(piece);
      if (copied && !ids) return nullptr;
      place[p].resize(std::size_t(piece->GetNumberOfPoints()), -1);
      std::vector<vtkIdType> rows;
      for (vtkIdType k = 0; k < piece->GetNumberOfPoints(); ++k) {
        if (copied && copied->GetValue(k) != 0) continue;
        if ((copied && ids->GetTuple1(k) < 0) != images) continue;
        place[p][std::size_t(k)] = points->InsertNextPoint(piece->GetPoint(k));
        if (copied && !images) of_id[vtkIdType(ids->GetTuple1(k))] = place[p][std::size_t(k)];
        rows.push_back(k);
      }
      if (!append_rows(piece->GetPointData(), rows, whole->GetPointData())) return nullptr;
    }
  vtkNew<vtkCellArray> verts, lines, polys;
  vtkNew<vtkIdList> cell;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    vtkPolyData* const piece = pieces[p];
    if (vtkUnsignedCharArray* const copied = ghost(piece))
      for (vtkIdType k = 0; k < piece->GetNumberOfPoints(); ++k)
        if (copied->GetValue(k) != 0) {
          const auto own = of_id.find(vtkIdType(id(piece)->GetTuple1(k)));
          if (own == of_id.end()) return nullptr;
          place[p][std::size_t(k)] = own->second;
        }
    const auto take = [&](vtkCellArray* from, vtkCellArray* to) {
      for (vtkIdType c = 0; c < from->GetNumberOfCells(); ++c) {
        from->GetCellAtId(c, cell);
        for (vtkIdType k = 0; k < cell->GetNumberOfIds(); ++k) {
          const vtkIdType at = cell->GetId(k);
          if (at < 0 || at >= piece->GetNumberOfPoints()) return false;
          cell->SetId(k, place[p][std::size_t(at)]);
        }
        to->InsertNextCell(cell);
      }
      return true;
    };
    if (!take(piece->GetVerts(), verts) || !take(piece->GetLines(), lines) || !take(piece->GetPolys(), polys))
      return nullptr;
    std::vector<vtkIdType> cells(std::size_t(piece->GetNumberOfCells()));
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = vtkIdType(c);
    if (!append_rows(piece->GetCellData(), cells, whole->GetCellData())) return nullptr;
  }
  whole->SetPoints(points);
  if (verts->GetNumberOfCells()) whole->SetVerts(verts);
  if (lines->GetNumberOfCells()) whole->SetLines(lines);
  if (polys->GetNumberOfCells()) whole->SetPolys(polys);
  if (pieces.front()->GetPointData()->HasArray("vtkGhostType")) whole->GetPointData()->RemoveArray("id");
  return whole;
}

/// The files that a .pvtp file joins; none where it is no such file.
inline std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> pieces;
  if (!std::filesystem::exists(file)) return pieces;
  const int before = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();  // the parser would print what it dislikes
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkObject::SetGlobalWarningDisplay(before);
  vtkXMLDataElement* const list = root ? root->FindNestedElementWithName("PPolyData") : nullptr;
  for (int k = 0; list && k < list->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement* const piece = list->GetNestedElement(k);
    const char* const source = piece->GetAttribute("Source");
    if (std::string_view(piece->GetName()) == "Piece" && source) pieces.push_back(file.parent_path() / source);
  }
  return pieces;
}

/// A .vtp file, or a .pvtp file and what it joins. Null when one of them is missing or damaged.
inline vtkSmartPointer<vtkPolyData> read_frame(const std::filesystem::path& file) {
  if (file.extension() != ".pvtp") return read_vtp(file);
  std::vector<vtkSmartPointer<vtkPolyData>> pieces;
  for (const std::filesystem::path& piece : pieces_of(file)) {
    pieces.push_back(read_vtp(piece));
    if (!pieces.back()) return nullptr;
  }
  return joined(pieces);
}

}  // namespace breccia::vtk
