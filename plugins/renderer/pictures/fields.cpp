// SPDX-License-Identifier: BSD-3-Clause
// One number of each particle or bond, out of what a frame has of them.
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "breccia/error.hpp"
#include "results.hpp"
#include "suggest.hpp"

namespace breccia::pictures {
namespace {

enum class Taken { component, magnitude, mean, von_mises };

/// What of an array is meant.
struct Chosen {
  vtkDataArray* array = nullptr;
  Taken taken = Taken::magnitude;
  int component = 0;
  std::string name;  ///< as a colour bar says it
};

std::string unit_of(vtkDataArray* array) {
  if (array->HasInformation() && array->GetInformation()->Has(vtkDataArray::UNITS_LABEL()))
    return array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
  return {};
}

/// By their places in an array of so many: six are a symmetric tensor as VTK has it, nine a tensor row by row.
std::vector<std::string> components_of(int count) {
  if (count == 3) return {"x", "y", "z"};
  if (count == 6) return {"xx", "yy", "zz", "xy", "yz", "xz"};
  if (count == 9) return {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  return {};
}
bool is_tensor(int count) { return count == 6 || count == 9; }

Mat3 tensor_at(vtkDataArray* array, vtkIdType k) {
  const auto at = [&](int c) { return array->GetComponent(k, c); };
  Mat3 t;
  if (array->GetNumberOfComponents() == 6) t << at(0), at(3), at(5), at(3), at(1), at(4), at(5), at(4), at(2);
  else t << at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8);
  return t;
}

/// sqrt(3/2 s:s) of the deviator s of the symmetric part; in two dimensions the difference of the principal values: as
/// post-processor `stress` has it.
double von_mises(const Mat3& tensor, int dimension) {
  Mat3 s = 0.5 * (tensor + tensor.transpose());
  const double mean = s.trace() / dimension;
  for (int k = 0; k < dimension; ++k) s(k, k) -= mean;
  return std::sqrt((dimension == 3 ? 1.5 : 2.0) * s.squaredNorm());
}

/// `part` of an array; nothing when the array has no such part.
std::optional<Chosen> part_of(vtkDataArray* array, const std::string& of, const std::string& part) {
  const int count = array->GetNumberOfComponents();
  if (count == 1) return {};
  if (part == "magnitude") return Chosen{array, Taken::magnitude, 0, is_tensor(count) ? of + "_" + part : of};
  const std::vector<std::string> components = components_of(count);
  for (std::string name : {part, std::string(part.rbegin(), part.rend())}) {  // xz of a symmetric tensor is zx, too
    const auto at = std::find(components.begin(), components.end(), name);
    if (at != components.end()) return Chosen{array, Taken::component, int(at - components.begin()), of + "_" + part};
  }
  if (!is_tensor(count)) return {};
  if (part == "mean") return Chosen{array, Taken::mean, 0, "mean_" + of};
  if (part == "von_mises") return Chosen{array, Taken::von_mises, 0, "von_Mises_" + of};
  return {};
}

/// No array when there is no such field. `why`: what is wrong with one whose name begins with that of an array.
Chosen chosen(vtkFieldData* data, const std::string& name, std::string& why) {
  if (vtkDataArray* whole = data->GetArray(name.c_str()))
    return {whole, Taken::magnitude, 0, is_tensor(whole->GetNumberOfComponents()) ? name + "_magnitude" : name};
  for (std::size_t end = name.rfind('_'); end != name.npos && end > 0; end = name.rfind('_', end - 1)) {
    const std::string of = name.substr(0, end), part = name.substr(end + 1);
    vtkDataArray* array = data->GetArray(of.c_str());
    if (!array) continue;
    if (const auto found = part_of(array, of, part)) return *found;
    if (!why.empty()) continue;
    const int count = array->GetNumberOfComponents();
    why = "the field `" + of + "` has no component `" + part + "`; ";
    if (count == 1) {
      why += "each value is one number";
    } else {
      why += "it has: ";
      for (const std::string& c : components_of(count)) why += c + ", ";
      why += is_tensor(count) ? "magnitude, mean, von_mises" : "magnitude";
    }
  }
  return {};
}

}  // namespace

bool has_field(vtkFieldData* data, const std::string& name) {
  std::string why;
  return chosen(data, name, why).array;
}

Values field_of(vtkFieldData* data, const std::string& name, int dimension) {
  std::string why;
  const Chosen c = chosen(data, name, why);
  if (!c.array && !why.empty()) throw UserError(why);
  if (!c.array) {
    std::vector<std::string> known;
    for (int k = 0; k < data->GetNumberOfArrays(); ++k)
      if (data->GetArray(k) && data->GetArrayName(k)) known.push_back(data->GetArrayName(k));
    auto nearest = nearest_of(name, known);
    if (!nearest) nearest = nearest_of(name.substr(0, name.rfind('_')), known);  // of another component
    throw UserError("there is no field `" + name + "`; " +
                    (nearest ? "did you mean `" + known[*nearest] + "`?" : "there are: " + first_of(known)));
  }
  Values v{{}, c.name, unit_of(c.array)};
  v.whole = c.array->GetDataType() != VTK_FLOAT && c.array->GetDataType() != VTK_DOUBLE;
  const int count = c.array->GetNumberOfComponents();
  const auto value = [&](vtkIdType k) -> double {
    if (c.taken == Taken::component || count == 1) return c.array->GetComponent(k, c.component);
    if (c.taken == Taken::mean) return tensor_at(c.array, k).trace() / dimension;
    if (c.taken == Taken::von_mises) return von_mises(tensor_at(c.array, k), dimension);
    if (is_tensor(count)) return tensor_at(c.array, k).norm();
    double square = 0;
    for (int m = 0; m < count; ++m) square += c.array->GetComponent(k, m) * c.array->GetComponent(k, m);
    return std::sqrt(square);
  };
  v.value.resize(std::size_t(c.array->GetNumberOfTuples()));
  for (vtkIdType k = 0; k < c.array->GetNumberOfTuples(); ++k) v.value[std::size_t(k)] = value(k);
  return v;
}

}  // namespace breccia::pictures
