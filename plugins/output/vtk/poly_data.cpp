// SPDX-License-Identifier: BSD-3-Clause
#include "poly_data.hpp"

#include <limits>

#include "arrays.hpp"

namespace breccia::vtk_output {

Bounds bounds_of(const SimulationView& view) {
  const ParticlesView& particles = view.particles;
  constexpr double far = std::numeric_limits<double>::infinity();
  double most[6] = {-far, -far, -far, -far, -far, -far};  // of the specimen upward and downward
  for (const std::size_t p : view.own_particles())
    for (int k = 0; k < 3; ++k) {
      most[k] = std::max(most[k], particles.position[p][k] + particles.radius[p]);
      most[k + 3] = std::max(most[k + 3], -(particles.position[p][k] - particles.radius[p]));
    }
  view.max(most);
  if (most[0] == -far) return {};
  return {-Vec3(most[3], most[4], most[5]), Vec3(most[0], most[1], most[2])};
}

vtkSmartPointer<vtkPolyData> particle_data(const SimulationView& view, std::span<const Field> fields,
                                           Precision precision) {
  const ParticlesView& p = view.particles;
  const OwnRows own = view.own_particles();
  const std::size_t n = own.size(), first = own.first();
  auto data = vtkSmartPointer<vtkPolyData>::New();
  std::vector<Vec3> points;
  for (const std::size_t k : own) points.push_back(p.position[k]);
  data->SetPoints(points_of(points));
  data->SetVerts(cells_of(n, 1, [](std::size_t c, int) { return c; }));  // so that ParaView shows and thresholds them
  vtkFieldData* on = data->GetPointData();
  add<vtkDoubleArray>(on, "radius", "m", n, [&](std::size_t k) { return p.radius[first + k]; });
  add<vtkTypeInt32Array>(on, "id", "", n, [&](std::size_t k) { return p.id[first + k]; });
  add_real(on, precision, "mass", "kg", n, [&](std::size_t k) { return p.mass[first + k]; });
  add_real(on, precision, "displacement", "m", n,
           [&](std::size_t k) -> Vec3 { return p.position[first + k] - p.initial_position[first + k]; });
  add_real(on, precision, "velocity", "m/s", n, [&](std::size_t k) { return p.velocity[first + k]; });
  add_real(on, precision, "angular_velocity", "rad/s", n, [&](std::size_t k) { return p.angular_velocity[first + k]; });
  add_real(on, precision, "force", "N", n, [&](std::size_t k) { return p.force[first + k]; });
  // What a protocol does to single particles, where it does. In two dimensions the plane holds all of them.
  const auto held = [&](std::size_t k) {
    return std::uint8_t(p.held[first + k] & (view.dimension == 2 ? dof::all & ~dof::out_of_plane : dof::all));
  };
  bool any = false;
  for (std::size_t k = 0; k < n && !p.held.empty(); ++k) any |= held(k) != 0;
  if (view.max(any) > 0) add<vtkTypeUInt8Array>(on, "held", "", n, held);
  if (!p.applied_force.empty())
    add_real(on, precision, "applied_force", "N", n, [&](std::size_t k) { return p.applied_force[first + k]; });
  if (!p.material.empty()) {
    add<vtkTypeInt32Array>(on, "material", "", n, [&](std::size_t k) { return p.material[first + k]; });
    add_material_names(data, view);
  }
  add_fields(on, fields, Field::On::particles, p.size(), own, precision);
  add_frame_facts(data, view);
  return data;
}

namespace {

/// Of the points of bonds in pieces: which particle each is (below zero: an image of one), and which stand among the
/// own particles of another piece.
void add_whose_points(vtkPolyData* data, const SimulationView& view) {
  const std::size_t n = view.particles.size(), points = std::size_t(data->GetNumberOfPoints());
  const OwnRows own = view.own_particles();
  add<vtkTypeInt32Array>(data->GetPointData(), "id", "", points,
                         [&](std::size_t k) { return k < n ? int(view.particles.id[k]) : -1; });
  add<vtkTypeUInt8Array>(data->GetPointData(), "vtkGhostType", "", points,
                         [&](std::size_t k) { return k < n && !own.contain(k) ? 1 : 0; });
}

}  // namespace

vtkSmartPointer<vtkPolyData> bond_data(const SimulationView& view, std::span<const Field> fields, Precision precision,
                                       bool piece) {
  const BondsView& b = view.bonds;
  const OwnRows own = view.own_bonds();
  const std::size_t n = own.size(), first = own.first();
  // A bond that broke and parted has no pair, and no force.
  const auto force = [&](std::size_t of) -> Vec3 {
    const std::size_t k = first + of;
    if (b.pair[k] == BondsView::no_pair) return Vec3::Zero();
    const PairForce& f = view.pairs.force[b.pair[k]];
    return {f.fx, f.fy, f.fz};
  };
  const auto normal = [&](std::size_t of) -> Vec3 {
    const std::size_t k = first + of;
    return view.branch(view.particles.position[b.i[k]], view.particles.position[b.j[k]]).normalized();
  };
  auto data = vtkSmartPointer<vtkPolyData>::New();
  // After the particles the images that bonds across a face of a space that repeats itself lead to.
  std::vector<Vec3> points(view.particles.position.begin(), view.particles.position.end());
  std::vector<Index> far(b.j.begin(), b.j.end());
  if (view.cell.repeats())
    for (const std::size_t k : own) {
      const Vec3 &from = points[b.i[k]], to = points[b.j[k]], branch = view.branch(from, to);
      if (view.cell.cells(to - from).isZero(0)) continue;
      far[k] = Index(points.size());
      points.push_back(from + branch);
    }
  data->SetPoints(points_of(points));
  data->SetLines(cells_of(n, 2, [&](std::size_t c, int end) { return end == 0 ? b.i[first + c] : far[first + c]; }));
  vtkFieldData* on = data->GetCellData();
  add<vtkTypeUInt8Array>(on, "state", "", n, [&](std::size_t k) { return std::uint8_t(b.state[first + k]); });
  add_real(on, precision, "force", "N", n, force);
  add_real(on, precision, "force_normal", "N", n, [&](std::size_t k) { return force(k).dot(normal(k)); });
  add_real(on, precision, "force_shear", "N", n, [&](std::size_t k) {
    const Vec3 f = force(k), along = normal(k);
    return (f - f.dot(along) * along).norm();
  });
  if (view.max(view.pairs.moment.empty() ? 0 : 1) > 0)
    add_real(on, precision, "moment", "N m", n, [&](std::size_t k) -> Vec3 {
      return b.pair[first + k] == BondsView::no_pair ? Vec3::Zero() : view.pairs.moment[b.pair[first + k]];
    });
  add_real(on, precision, "initial_distance", "m", n, [&](std::size_t k) { return b.initial_distance[first + k]; });
  add_real(on, precision, "break_time", "s", n,
           [&](std::size_t k) { return b.crack(first + k) ? b.crack(first + k)->time : -1; });
  add_real(on, precision, "break_position", "m", n,
           [&](std::size_t k) { return b.crack(first + k) ? b.crack(first + k)->position : Vec3::Zero().eval(); });
  add_real(on, precision, "break_normal", "1", n,
           [&](std::size_t k) { return b.crack(first + k) ? b.crack(first + k)->normal : Vec3::Zero().eval(); });
  add_real(on, precision, "released_energy", "J", n,
           [&](std::size_t k) { return b.crack(first + k) ? b.crack(first + k)->energy : 0; });
  add_real(on, precision, "crack_radius", "m", n, [&](std::size_t k) {
    return std::min(view.particles.radius[b.i[first + k]], view.particles.radius[b.j[first + k]]);
  });
  if (const auto& of = view.particles.material; !of.empty()) {
    add<vtkTypeInt32Array>(on, "material_i", "", n, [&](std::size_t k) { return of[b.i[first + k]]; });
    add<vtkTypeInt32Array>(on, "material_j", "", n, [&](std::size_t k) { return of[b.j[first + k]]; });
  }
  add_fields(on, fields, Field::On::bonds, b.size(), own, precision);
  if (piece) add_whose_points(data, view);
  add_frame_facts(data, view);
  return data;
}

namespace {

/// Four corners each: a plane is one square about the specimen, a cylinder a ring of strips as long as the specimen.
void add_wall_quads(const WallView& w, const Bounds& specimen, std::vector<Vec3>& corners) {
  const Vec3 centre = 0.5 * (specimen.low + specimen.high), half = 0.5 * (specimen.high - specimen.low);
  // Tangents from the coordinate axis farthest from the normal: squares stay aligned with the specimen.
  int least = 0;
  w.normal.cwiseAbs().minCoeff(&least);
  const Vec3 a = w.normal.cross(Vec3::Unit(least)).normalized(), b = w.normal.cross(a);
  if (w.cylinder_radius <= 0) {
    const double side = 1.15 * std::max(half.dot(a.cwiseAbs()), half.dot(b.cwiseAbs()));
    const Vec3 middle = centre - (centre - w.point).dot(w.normal) * w.normal;
    for (const auto& [s, t] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      corners.push_back(middle + side * (s * a + t * b));
    return;
  }
  constexpr int strips = 48;
  const Vec3 middle = w.point + (centre - w.point).dot(w.normal) * w.normal,
             along = half.dot(w.normal.cwiseAbs()) * w.normal;
  const auto rim = [&](int k) {
    const double angle = 2 * M_PI * k / strips;
    return Vec3(middle + w.cylinder_radius * (std::cos(angle) * a + std::sin(angle) * b));
  };
  for (int k = 0; k < strips; ++k)
    for (const Vec3& corner :
         {Vec3(rim(k) - along), Vec3(rim(k + 1) - along), Vec3(rim(k + 1) + along), Vec3(rim(k) + along)})
      corners.push_back(corner);
}

}  // namespace

vtkSmartPointer<vtkPolyData> wall_data(const SimulationView& view, const Bounds& specimen) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> wall_of;  // of each quad
  for (std::size_t w = 0; w < view.walls.size(); ++w) {
    add_wall_quads(view.walls[w], specimen, corners);
    wall_of.resize(corners.size() / 4, w);
  }
  const std::size_t n = wall_of.size();
  const auto wall = [&](std::size_t quad) -> const WallView& { return view.walls[wall_of[quad]]; };
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points_of(corners));
  data->SetPolys(cells_of(n, 4, [](std::size_t c, int k) { return 4 * c + std::size_t(k); }));
  vtkFieldData* on = data->GetCellData();
  vtkNew<vtkStringArray> names;
  for (std::size_t k = 0; k < n; ++k) names->InsertNextValue(wall(k).name);
  attach(on, names, "name", "");
  add<vtkDoubleArray>(on, "force", "N", n, [&](std::size_t k) { return wall(k).force; });
  add<vtkDoubleArray>(on, "displacement", "m", n, [&](std::size_t k) { return wall(k).displacement; });
  add<vtkDoubleArray>(on, "velocity", "m/s", n, [&](std::size_t k) { return wall(k).velocity; });
  add<vtkDoubleArray>(on, "normal", "1", n, [&](std::size_t k) { return wall(k).normal; });
  add<vtkTypeInt32Array>(on, "contacts", "", n, [&](std::size_t k) { return int(wall(k).contacts); });
  add_frame_facts(data, view);
  return data;
}

}  // namespace breccia::vtk_output
