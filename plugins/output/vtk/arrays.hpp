// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of a data set, with their units.
#pragma once

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeUInt8Array.h>

#include <algorithm>
#include <limits>

#include "../../shared/checked_field.hpp"
#include "poly_data.hpp"

namespace breccia::vtk_output {

/// Adds `array` under a name that must be free; the unit travels in VTK's own UNITS_LABEL key.
inline void attach(vtkFieldData* data, vtkAbstractArray* array, const std::string& name, const std::string& unit) {
  if (data->HasArray(name.c_str())) refuse_second_field(name, "vtk");
  array->SetName(name.c_str());
  if (!unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
  data->AddArray(array);
}

/// One array of a data set: `get(k)` gives a number or a Vec3.
template <class Array, class Get>
void add(vtkFieldData* data, const char* name, const char* unit, std::size_t size, Get&& get) {
  constexpr int components = std::is_convertible_v<decltype(get(0)), Vec3> ? 3 : 1;
  vtkNew<Array> array;
  using Value = typename Array::ValueType;
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(vtkIdType(size));
  Value* to = array->GetPointer(0);
  for (std::size_t k = 0; k < size; ++k) {
    if constexpr (components == 3) {
      const Vec3 v = get(k);
      for (int c = 0; c < 3; ++c) *to++ = Value(v[c]);
    } else {
      *to++ = Value(get(k));
    }
  }
  attach(data, array, name, unit);
}

template <class Get>
void add_real(vtkFieldData* data, Precision precision, const char* name, const char* unit, std::size_t size,
              Get&& get) {
  if (precision == Precision::single_precision) add<vtkFloatArray>(data, name, unit, size, get);
  else add<vtkDoubleArray>(data, name, unit, size, get);
}

template <class Array>
void add_field(vtkFieldData* data, const Field& field, const OwnRows& rows) {
  vtkNew<Array> array;
  using Value = typename Array::ValueType;
  array->SetNumberOfComponents(field.components);
  array->SetNumberOfTuples(vtkIdType(rows.size()));
  Value* to = array->GetPointer(0);
  const auto n = std::size_t(field.components);
  for (std::size_t k = rows.first() * n; k < rows.behind() * n; ++k) *to++ = Value(field.values[k]);
  static constexpr const char *of_vector[] = {"x", "y", "z"}, *of_tensor[] = {"xx", "yy", "zz", "xy", "yz", "xz"};
  if (field.components == 3 || field.components == 6)
    for (int c = 0; c < field.components; ++c)
      array->SetComponentName(c, field.components == 3 ? of_vector[c] : of_tensor[c]);
  attach(data, array, field.name, field.unit);
}

/// 32 bits where they do: every program can read those.
inline void add_whole_field(vtkFieldData* data, const Field& field, const OwnRows& rows) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  const bool small =
      std::all_of(field.values.begin(), field.values.end(), [](double v) { return v <= most && v >= -most; });
  if (small) add_field<vtkTypeInt32Array>(data, field, rows);
  else add_field<vtkTypeInt64Array>(data, field, rows);
}

/// Of as many things as there are those in `rows`.
inline void add_fields(vtkFieldData* data, std::span<const Field> fields, Field::On on, std::size_t size,
                       const OwnRows& rows, Precision precision) {
  for (const Field& f : fields) {
    if (f.on != on) continue;
    check_field(f, size, "vtk");
    if (f.whole) add_whole_field(data, f, rows);
    else if (precision == Precision::single_precision) add_field<vtkFloatArray>(data, f, rows);
    else add_field<vtkDoubleArray>(data, f, rows);
  }
}

inline vtkSmartPointer<vtkPoints> points_of(Strided<const Vec3> positions) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(positions.size()));
  for (std::size_t p = 0; p < positions.size(); ++p) points->SetPoint(vtkIdType(p), positions[p].data());
  return points;
}

/// Cells of equal size over the given point numbers, stored in 32 bits.
template <class Point>
vtkSmartPointer<vtkCellArray> cells_of(std::size_t cells, int points_per_cell, Point&& point) {
  vtkNew<vtkTypeInt32Array> offsets, connectivity;
  offsets->SetNumberOfValues(vtkIdType(cells) + 1);
  connectivity->SetNumberOfValues(vtkIdType(cells) * points_per_cell);
  for (std::size_t c = 0; c <= cells; ++c) offsets->SetValue(vtkIdType(c), int(c) * points_per_cell);
  for (std::size_t c = 0; c < cells; ++c)
    for (int k = 0; k < points_per_cell; ++k)
      connectivity->SetValue(vtkIdType(c) * points_per_cell + k, int(point(c, k)));
  auto array = vtkSmartPointer<vtkCellArray>::New();
  array->SetData(offsets, connectivity);
  return array;
}

/// What holds for the whole frame: its time and the specimen as it was when loading began.
inline void add_frame_facts(vtkPolyData* data, const SimulationView& view) {
  vtkFieldData* facts = data->GetFieldData();
  add<vtkDoubleArray>(facts, "TimeValue", "s", 1, [&](std::size_t) { return view.time; });
  add<vtkTypeInt32Array>(facts, "dimension", "", 1, [&](std::size_t) { return view.dimension; });
  if (view.cell.repeats())
    add<vtkDoubleArray>(facts, "cell_vectors", "m", 3,
                        [&](std::size_t k) -> Vec3 { return view.cell.vectors().col(int(k)); });
  if (!(view.specimen.height > 0)) return;
  add<vtkDoubleArray>(facts, "specimen_base", "m", 1, [&](std::size_t) { return view.specimen.base; });
  add<vtkDoubleArray>(facts, "specimen_axis", "1", 1, [&](std::size_t) { return view.specimen.axis; });
  add<vtkDoubleArray>(facts, "specimen_extent", "m", 1, [&](std::size_t) { return view.specimen.extent; });
  add<vtkDoubleArray>(facts, "specimen_height", "m", 1, [&](std::size_t) { return view.specimen.height; });
  vtkNew<vtkStringArray> outline;
  constexpr const char* outlines[] = {"cylinder", "box", "ellipsoid", "irregular"};
  outline->InsertNextValue(outlines[int(view.specimen.outline)]);
  attach(facts, outline, "specimen_outline", "");
}

inline void add_material_names(vtkPolyData* data, const SimulationView& view) {
  vtkNew<vtkStringArray> names;
  for (const std::string& name : view.materials) names->InsertNextValue(name);
  attach(data->GetFieldData(), names, "material_names", "");
}

}  // namespace breccia::vtk_output
