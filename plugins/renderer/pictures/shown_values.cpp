// SPDX-License-Identifier: BSD-3-Clause
// By which values the particles of a scene are coloured.
#include <vtkPointData.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "breccia/error.hpp"
#include "scene_pictures.hpp"

namespace breccia::pictures {
namespace {

/// Along `TestSetup::across`. A disc may roll between its platens, and more than it opens: that is taken off.
Values displacement_across(const SceneFrame& frame) {
  const TestSetup& setup = frame.setup;
  const Vec3& along = setup.across;
  if (along.isZero()) throw UserError("the files do not say along which direction this specimen opens or bends");
  vtkDataArray* displacement = frame.particles->GetPointData()->GetArray("displacement");
  if (!displacement || displacement->GetNumberOfComponents() != 3) throw UserError("there is no field `displacement`");
  const Spheres spheres = spheres_of(frame.particles);
  std::vector<Vec3> u(spheres.size());
  for (std::size_t p = 0; p < u.size(); ++p) displacement->GetTuple(vtkIdType(p), u[p].data());
  Values v{{}, "displacement_across", "m"};
  for (int k = 0; k < 3; ++k)
    if (along[k] > 0.999) v.name = std::string("displacement_") + "xyz"[k];
  Vec3 middle = Vec3::Zero(), shift = Vec3::Zero();
  double turn = 0;
  const Vec3 about = setup.dimension == 2 ? Vec3(Vec3::UnitZ()) : setup.face;
  if (setup.splits) {
    const Vec3 centre = setup.specimen->base + 0.5 * setup.specimen->height * setup.specimen->axis;
    std::vector<std::size_t> near;  // what flew off does not roll
    for (std::size_t p = 0; p < u.size(); ++p)
      if ((spheres.position[p] - centre).norm() < setup.size()) near.push_back(p);
    for (const std::size_t p : near) {
      middle += spheres.position[p] / double(near.size());
      shift += u[p] / double(near.size());
    }
    double moment = 0, inertia = 0;
    for (const std::size_t p : near) {
      const Vec3 arm = about.cross(spheres.position[p] - middle);
      moment += arm.dot(u[p] - shift);
      inertia += arm.squaredNorm();
    }
    turn = inertia > 0 ? moment / inertia : 0;
    v.name += "_without_rolling";
  }
  for (std::size_t p = 0; p < u.size(); ++p)
    v.value.push_back(along.dot(u[p] - shift - turn * about.cross(spheres.position[p] - middle)));
  return v;
}

}  // namespace

Values colour_values(const SceneFrame& frame, const SceneWish& wish) {
  vtkPointData* data = frame.particles->GetPointData();
  if (wish.across) return displacement_across(frame);
  if (!wish.field.empty()) return field_of(data, wish.field, frame.setup.dimension);
  if (data->HasArray("damage")) {
    Values damage = field_of(data, "damage");
    if (!data->HasArray("displacement") ||
        std::any_of(damage.value.begin(), damage.value.end(), [](double v) { return v > 0; }))
      return damage;
  }
  return field_of(data, data->HasArray("displacement") ? "displacement" : "radius");
}

}  // namespace breccia::pictures
