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

namespace {

/// How large each bond is drawn, when it is broken; nothing where it is the particles that say it.
std::optional<Values> sizes_of(vtkPolyData* bonds, const std::string& size_by) {
  if (size_by.empty() || size_by == "area") return {};
  vtkCellData* data = bonds->GetCellData();
  const bool energy = size_by == "energy";
  if (energy && !data->HasArray("released_energy"))
    throw UserError(
        "`size_by: energy` needs the bond field `released_energy`, which these files, of an older Breccia, "
        "do not have; leave it out, or run again");
  Values v = field_of(data, energy ? "released_energy" : size_by, facts_of(bonds).dimension);
  // A bond that was pushed hard may have taken some energy as it broke: it released none.
  for (double& x : v.value) x = !std::isfinite(x) ? 0 : energy ? std::max(x, 0.0) : std::abs(x);
  return v;
}

}  // namespace

std::vector<BrokenBond> broken_bonds(vtkPolyData* bonds, const std::string& size_by, double since,
                                     std::optional<CrackScale>& scale) {
  vtkCellData* data = bonds->GetCellData();
  vtkDataArray *state = data->GetArray("state"), *position = data->GetArray("break_position"),
               *normal = data->GetArray("break_normal"), *radius = data->GetArray("crack_radius"),
               *time = data->GetArray("break_time");
  if (!state || !position || !normal || !radius || !time)
    throw UserError("the bond file lacks one of state, break_time, break_position, break_normal, crack_radius");
  const std::optional<Values> sizes = sizes_of(bonds, size_by);

  std::vector<BrokenBond> cracks;
  std::vector<double> size;
  double largest = 0;
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
    if (sizes) size.push_back(sizes->value[std::size_t(b)]);
    cracks.push_back(c);
  }
  if (!sizes || cracks.empty()) return cracks;
  if (!scale) scale = CrackScale{largest, *std::max_element(size.begin(), size.end()), sizes->name, sizes->unit};
  for (std::size_t k = 0; k < cracks.size(); ++k)
    cracks[k].radius = scale->value > 0 ? scale->radius * std::sqrt(size[k] / scale->value) : 0;
  return cracks;
}

}  // namespace breccia::pictures
