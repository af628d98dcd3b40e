// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "arrays.hpp"

namespace breccia::vtk_output {

vtkSmartPointer<vtkPolyData> crack_data(const SimulationView& view, Precision precision) {
  const BondsView& b = view.bonds;
  std::vector<std::size_t> bond_of(b.cracks.size(), b.size());  // of each crack; none of those that count elsewhere
  for (const std::size_t k : view.own_bonds())
    if (b.crack(k)) bond_of[b.crack_of[k]] = k;
  std::vector<std::size_t> bond;
  for (const std::size_t k : bond_of)
    if (k < b.size()) bond.push_back(k);
  const std::size_t n = bond.size();
  const auto half_length = [&](std::size_t c) {
    return std::min(view.particles.radius[b.i[bond[c]]], view.particles.radius[b.j[bond[c]]]);
  };
  std::vector<Vec3> points;
  for (const std::size_t k : bond) points.push_back(b.crack(k)->position);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points_of(points));
  data->SetVerts(cells_of(n, 1, [](std::size_t c, int) { return c; }));
  vtkFieldData* on = data->GetPointData();
  add<vtkTypeUInt8Array>(on, "mode", "", n, [&](std::size_t c) { return std::uint8_t(b.state[bond[c]]); });
  add_real(on, precision, "time", "s", n, [&](std::size_t c) { return b.crack(bond[c])->time; });
  add_real(on, precision, "normal", "1", n, [&](std::size_t c) { return b.crack(bond[c])->normal; });
  add_real(on, precision, "half_length", "m", n, half_length);
  add_real(on, precision, "area", "m2", n, [&](std::size_t c) {
    const double r = half_length(c);
    return view.dimension == 2 ? 2 * r * view.thickness : std::numbers::pi * r * r;
  });
  add_real(on, precision, "energy", "J", n, [&](std::size_t c) { return b.crack(bond[c])->energy; });
  const auto ends = [&](const char* name, std::span<const Index> end) {
    add<vtkTypeInt32Array>(on, name, "", n, [&](std::size_t c) { return view.particles.id[end[bond[c]]]; });
  };
  ends("particle_i", b.i);
  ends("particle_j", b.j);
  if (const auto& of = view.particles.material; !of.empty()) {
    add<vtkTypeInt32Array>(on, "material_i", "", n, [&](std::size_t c) { return of[b.i[bond[c]]]; });
    add<vtkTypeInt32Array>(on, "material_j", "", n, [&](std::size_t c) { return of[b.j[bond[c]]]; });
    add_material_names(data, view);
  }
  add_frame_facts(data, view);
  return data;
}

}  // namespace breccia::vtk_output
