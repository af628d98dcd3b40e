// SPDX-License-Identifier: BSD-3-Clause
#include "cracks.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <algorithm>
#include <cmath>

#include "breccia/error.hpp"
#include "breccia/views.hpp"

namespace breccia::pictures {

bool has_broken_bonds(vtkPolyData* bonds) {
  vtkDataArray* state = bonds->GetCellData()->GetArray("state");
  for (vtkIdType b = 0; state && b < state->GetNumberOfTuples(); ++b)
    if (is_broken(BondState(int(state->GetComponent(b, 0))))) return true;
  return false;
}

std::vector<BrokenBond> broken_bonds(vtkPolyData* bonds, const std::string& size_by, double since) {
  vtkCellData* data = bonds->GetCellData();
  vtkDataArray *state = data->GetArray("state"), *position = data->GetArray("break_position"),
               *normal = data->GetArray("break_normal"), *radius = data->GetArray("crack_radius"),
               *time = data->GetArray("break_time");
  if (!state || !position || !normal || !radius || !time)
    throw UserError("the bond file lacks one of state, break_time, break_position, break_normal, crack_radius");
  std::vector<double> size;
  if (!size_by.empty()) size = field_of(data, size_by).value;

  std::vector<BrokenBond> cracks;
  double largest = 0, most = 0;
  for (vtkIdType b = 0; b < state->GetNumberOfTuples(); ++b) {
    const auto s = BondState(int(state->GetComponent(b, 0)));
    if (!is_broken(s)) continue;
    BrokenBond c;
    c.time = time->GetComponent(b, 0);
    if (!(c.time >= since)) continue;
    position->GetTuple(b, c.position.data());
    normal->GetTuple(b, c.normal.data());
    c.radius = radius->GetComponent(b, 0);
    c.mode = std::min<std::size_t>(std::size_t(s) - std::size_t(BondState::broken_tension), 2);
    largest = std::max(largest, c.radius);
    if (!size.empty()) {
      c.radius = std::isfinite(size[std::size_t(b)]) ? std::abs(size[std::size_t(b)]) : 0;
      most = std::max(most, c.radius);
    }
    cracks.push_back(c);
  }
  if (!size.empty())
    for (BrokenBond& c : cracks) c.radius = most > 0 ? largest * std::sqrt(c.radius / most) : 0;
  return cracks;
}

}  // namespace breccia::pictures
