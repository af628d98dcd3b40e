// SPDX-License-Identifier: BSD-3-Clause
#include "test_setup.hpp"

#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace breccia::pictures {
namespace {

struct Plane : Platen {
  double force = 0;
};

/// A plane is drawn as one square, a cylinder as many strips of one name.
std::vector<Plane> planes_of(vtkPolyData* walls) {
  auto* names = vtkStringArray::SafeDownCast(walls->GetCellData()->GetAbstractArray("name"));
  vtkDataArray *normal = walls->GetCellData()->GetArray("normal"), *force = walls->GetCellData()->GetArray("force");
  if (!names || !normal || normal->GetNumberOfComponents() != 3) return {};
  std::map<std::string, int> count;
  for (vtkIdType w = 0; w < names->GetNumberOfValues(); ++w) ++count[names->GetValue(w)];
  std::vector<Plane> planes;
  vtkNew<vtkIdList> corners;
  for (vtkIdType w = 0; w < std::min(walls->GetNumberOfCells(), names->GetNumberOfValues()); ++w) {
    walls->GetCellPoints(w, corners);
    if (count[names->GetValue(w)] != 1 || corners->GetNumberOfIds() == 0) continue;
    Plane plane;
    plane.point.setZero();
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
      Vec3 x;
      walls->GetPoint(corners->GetId(k), x.data());
      plane.point += x / double(corners->GetNumberOfIds());
    }
    normal->GetTuple(w, plane.normal.data());
    if (!(plane.normal.norm() > 0.5)) continue;
    plane.normal.normalize();
    Vec3 f = Vec3::Zero();
    if (force && force->GetNumberOfComponents() == 3) force->GetTuple(w, f.data());
    plane.force = f.norm();
    planes.push_back(plane);
  }
  return planes;
}

/// The two planes opposite each other that load the specimen: those across its axis, or else those that press hardest.
std::vector<Platen> platens_among(const std::vector<Plane>& planes, const std::optional<SpecimenShape>& specimen) {
  std::vector<Platen> best;
  double most = -1;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      if (planes[i].normal.dot(planes[j].normal) > -0.999) continue;
      const bool axial = specimen && std::abs(planes[i].normal.dot(specimen->axis)) > 0.999;
      const double rank = axial ? std::numeric_limits<double>::max() : planes[i].force + planes[j].force;
      if (!(rank > most)) continue;
      most = rank;
      best = {planes[i], planes[j]};
    }
  return best;
}

std::vector<Vec3> vectors(vtkPolyData* particles, const char* name) {
  vtkDataArray* array = particles->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 3) return {};
  std::vector<Vec3> all(std::size_t(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < all.size(); ++k) array->GetTuple(vtkIdType(k), all[k].data());
  return all;
}

bool acts(const std::vector<Vec3>& force) {
  return std::any_of(force.begin(), force.end(), [](const Vec3& f) { return f.norm() > 0; });
}

/// Loaded particles that lie next to each other along the axis and are pushed the same way make one load.
std::vector<DeadLoad> loads_on(const Spheres& spheres, const std::vector<Vec3>& force, const SpecimenShape& specimen) {
  std::vector<std::size_t> order;
  for (std::size_t p = 0; p < force.size(); ++p)
    if (force[p].norm() > 0) order.push_back(p);
  const auto height = [&](std::size_t p) { return spheres.position[p].dot(specimen.axis); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  std::vector<DeadLoad> loads;
  for (std::size_t k = 0; k < order.size();) {
    const Vec3 direction = force[order[k]].normalized();
    Vec3 middle = Vec3::Zero();
    std::size_t end = k;
    while (end < order.size() && force[order[end]].normalized().dot(direction) > 0.9 &&
           (end == k || height(order[end]) - height(order[end - 1]) < 0.1 * specimen.height))
      middle += spheres.position[order[end++]];
    middle /= double(end - k);
    double reach = 0;  // to the surface on the side that it comes from
    for (std::size_t m = k; m < end; ++m)
      reach = std::max(reach, (middle - spheres.position[order[m]]).dot(direction) + spheres.radius[order[m]]);
    loads.push_back({middle - reach * direction, direction});
    k = end;
  }
  return loads;
}

void see_dead_loads(TestSetup& s, const Spheres& spheres, const std::vector<Vec3>& force) {
  s.loads = loads_on(spheres, force, *s.specimen);
  if (s.loads.empty()) return;
  const Vec3 sum = std::accumulate(force.begin(), force.end(), Vec3(Vec3::Zero()));
  s.load = sum.norm() > 1e-9 * force.size() ? sum.normalized() : s.loads[0].direction;
  const Vec3& axis = s.specimen->axis;
  s.across = s.load;
  if (std::abs(s.load.dot(axis)) > 0.9) return;
  s.best_from_the_face = true;
  if (s.dimension == 2) return;
  s.face = axis.cross(s.load).normalized();
  s.up = -s.load;
}

/// Ends that are held: plates are glued to them. Apart: they have moved from each other.
void see_held_ends(TestSetup& s, const Spheres& spheres, const std::vector<std::uint8_t>& held,
                   const std::vector<Vec3>& displacement) {
  const Vec3& axis = s.specimen->axis;
  const Vec3 middle = s.specimen->base + 0.5 * s.specimen->height * axis;
  double end[2] = {0, 0}, moved[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t p = 0; p < held.size(); ++p) {
    if (!held[p]) continue;
    const double at = (spheres.position[p] - middle).dot(axis);
    const int side = at > 0;
    end[side] = std::max(end[side], std::abs(at) + spheres.radius[p]);
    if (p < displacement.size()) moved[side] += displacement[p].dot(axis);
    ++count[side];
  }
  if (count[0] == 0 || count[1] == 0) return;
  s.load = axis;
  s.platens = {{middle - end[0] * axis, axis}, {middle + end[1] * axis, -axis}};
  if (!(moved[1] / count[1] > moved[0] / count[0])) return;
  s.across = axis;
  s.best_from_the_face = true;
}

/// The view that is square to the axis, which stands upright.
void see_along_axis(TestSetup& s) {
  const Vec3& axis = s.specimen->axis;
  s.up = axis.sum() < 0 ? Vec3(-axis) : axis;
  const Vec3 toward = std::abs(axis.y()) < 0.9 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
  s.face = (toward - toward.dot(axis) * axis).normalized();
}

}  // namespace

Spheres spheres_of(vtkPolyData* particles) {
  Spheres s;
  s.radius = field_of(particles->GetPointData(), "radius").value;
  s.position.resize(s.radius.size());
  s.number.resize(s.radius.size());
  std::iota(s.number.begin(), s.number.end(), std::size_t(0));
  for (std::size_t p = 0; p < s.radius.size(); ++p) particles->GetPoint(vtkIdType(p), s.position[p].data());
  return s;
}

std::vector<std::uint8_t> held_of(vtkPolyData* particles) {
  std::vector<std::uint8_t> held(std::size_t(particles->GetNumberOfPoints()), 0);
  if (vtkDataArray* array = particles->GetPointData()->GetArray("held"))
    for (std::size_t p = 0; p < std::min(held.size(), std::size_t(array->GetNumberOfTuples())); ++p)
      held[p] = array->GetComponent(vtkIdType(p), 0) != 0;
  return held;
}

bool was_released(vtkPolyData* particles) {
  const std::vector<Vec3> force = vectors(particles, "applied_force");
  return !force.empty() && !acts(force);
}

TestSetup setup_of(vtkPolyData* particles, vtkPolyData* bonds, vtkPolyData* walls) {
  TestSetup s;
  const FrameFacts facts = particles ? facts_of(particles) : bonds ? facts_of(bonds) : FrameFacts{};
  s.dimension = facts.dimension;
  s.specimen = facts.specimen;
  if (!s.specimen || !(s.specimen->axis.norm() > 0.5)) return s;
  see_along_axis(s);
  const Vec3& axis = s.specimen->axis;
  if (walls) s.platens = platens_among(planes_of(walls), s.specimen);
  if (!s.platens.empty()) {
    s.load = s.platens[0].normal.sum() < 0 ? Vec3(-s.platens[0].normal) : s.platens[0].normal;
    using Outline = SpecimenShape::Outline;
    if (s.dimension == 2) {
      s.best_from_the_face = s.specimen->outline == Outline::ellipsoid;  // a disc between platens splits
      s.splits = s.best_from_the_face;
      if (s.splits) s.across = s.load.cross(Vec3::UnitZ());
    } else if (std::abs(s.load.dot(axis)) < 0.1) {
      s.best_from_the_face = s.splits = true;  // a cylinder on its mantle, too
      s.face = axis.sum() < 0 ? Vec3(-axis) : axis;
      if (std::abs(axis.y()) > 0.5) s.face = -axis;  // seen as the front is
      s.up = s.load;
      s.across = s.up.cross(s.face);
    }
    return s;
  }
  if (!particles) return s;
  const Spheres spheres = spheres_of(particles);
  std::vector<std::uint8_t> held = held_of(particles);
  const auto force = vectors(particles, "applied_force");
  if (force.size() == spheres.size() && acts(force)) {
    see_dead_loads(s, spheres, force);
    s.held = std::move(held);
  } else {
    see_held_ends(s, spheres, held, vectors(particles, "displacement"));
  }
  return s;
}

}  // namespace breccia::pictures
