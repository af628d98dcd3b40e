// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace breccia::pictures {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Two unit vectors that make a right-handed frame with n.
std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3 a = n.cross(Vec3::Unit(least)).normalized();
  return {a, n.cross(a)};
}

void add_actor(vtkRenderer* renderer, vtkMapper* mapper, double ambient, double diffuse, double specular) {
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* p = actor->GetProperty();
  p->SetAmbient(ambient);
  p->SetDiffuse(diffuse);
  p->SetSpecular(specular);
  p->SetSpecularPower(20);
  renderer->AddActor(actor);
}

void add_edges(vtkRenderer* renderer, vtkPoints* points, vtkCellArray* lines, double line_width) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.45, 0.45, 0.45);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->SetLineWidth(float(line_width));
  renderer->AddActor(actor);
}

/// The inner side of a closed surface: its front faces would hide what is inside.
void add_back_wall(vtkRenderer* renderer, vtkPoints* points, vtkCellArray* faces) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(faces);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.955, 0.955, 0.955);
  actor->GetProperty()->SetLighting(false);
  actor->GetProperty()->FrontfaceCullingOn();
  renderer->AddActor(actor);
}

void insert_cell(vtkCellArray* cells, std::initializer_list<vtkIdType> points) {
  cells->InsertNextCell(vtkIdType(points.size()), points.begin());
}

void add_box(vtkRenderer* renderer, const Vec3& low, const Vec3& high, double line_width) {
  vtkNew<vtkPoints> points;
  for (int c = 0; c < 8; ++c)
    points->InsertNextPoint(c & 1 ? high.x() : low.x(), c & 2 ? high.y() : low.y(), c & 4 ? high.z() : low.z());
  vtkNew<vtkCellArray> faces, edges;
  insert_cell(faces, {0, 2, 3, 1});
  insert_cell(faces, {4, 5, 7, 6});
  insert_cell(faces, {0, 1, 5, 4});
  insert_cell(faces, {2, 6, 7, 3});
  insert_cell(faces, {0, 4, 6, 2});
  insert_cell(faces, {1, 3, 7, 5});
  for (int c = 0; c < 8; ++c)
    for (const int bit : {1, 2, 4})
      if (!(c & bit)) insert_cell(edges, {c, c | bit});
  add_back_wall(renderer, points, faces);
  add_edges(renderer, points, edges, line_width);
}

void add_cylinder(vtkRenderer* renderer, const SpecimenShape& s, double line_width) {
  constexpr int sides = 128;
  const auto [a, b] = tangents(s.axis);
  const double radius = 0.5 * s.extent.dot(a.cwiseAbs());
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces, edges;
  std::vector<vtkIdType> bottom, top;
  for (int k = 0; k < sides; ++k) {
    const double t = 2 * pi * k / sides;
    const Vec3 at = s.base + radius * (std::cos(t) * a + std::sin(t) * b), above = at + s.height * s.axis;
    bottom.push_back(points->InsertNextPoint(at.data()));
    top.push_back(points->InsertNextPoint(above.data()));
  }
  for (int k = 0; k < sides; ++k) {
    const int next = (k + 1) % sides;
    insert_cell(faces, {bottom[k], bottom[next], top[next], top[k]});
    insert_cell(edges, {bottom[k], bottom[next]});
    insert_cell(edges, {top[k], top[next]});
  }
  faces->InsertNextCell(sides, top.data());
  const std::vector<vtkIdType> down(bottom.rbegin(), bottom.rend());
  faces->InsertNextCell(sides, down.data());
  add_back_wall(renderer, points, faces);
  add_edges(renderer, points, edges, line_width);
}

}  // namespace

void add_lights(vtkRenderer* renderer) {
  renderer->RemoveAllLights();
  renderer->AutomaticLightCreationOff();
  // In camera coordinates: x right, y up, z toward the reader.
  const auto add = [&](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
  add(-0.7, 0.9, 1.2, 0.8);
  add(0.9, 0.1, 0.8, 0.35);
}

void add_spheres(vtkRenderer* renderer, const Spheres& spheres, const std::vector<double>& value,
                 vtkLookupTable* colours) {
  const vtkIdType n = vtkIdType(spheres.radius.size());
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radius, shade;
  vtkNew<vtkCellArray> vertices;  // the mapper draws nothing without them
  vertices->InsertNextCell(int(n));
  points->SetNumberOfPoints(n);
  radius->SetName("radius");
  radius->SetNumberOfValues(n);
  shade->SetName("value");
  shade->SetNumberOfValues(n);
  for (vtkIdType p = 0; p < n; ++p) {
    points->SetPoint(p, spheres.position[std::size_t(p)].data());
    vertices->InsertCellPoint(p);
    radius->SetValue(p, float(spheres.radius[std::size_t(p)]));
    shade->SetValue(p, float(value[std::size_t(p)]));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->AddArray(radius);
  data->GetPointData()->SetScalars(shade);
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleArray("radius");
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  add_actor(renderer, mapper, 0.28, 0.78, 0.04);
}

void add_occlusion(vtkRenderer* renderer, const Spheres& spheres) {
  if (spheres.radius.empty()) return;
  const double mean =
      std::accumulate(spheres.radius.begin(), spheres.radius.end(), 0.0) / double(spheres.radius.size());
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetDelegatePass(steps);
  occlusion->SetRadius(4 * mean);
  occlusion->SetBias(0.08 * mean);
  occlusion->SetKernelSize(32);
  occlusion->BlurOn();
  renderer->SetPass(occlusion);
}

void add_cracks(vtkRenderer* renderer, const std::vector<Crack>& cracks, int dimension) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  const int sides = dimension == 2 ? 4 : 20;
  std::vector<vtkIdType> corner(std::size_t(sides), 0);
  for (const Crack& c : cracks) {
    const auto [a, b] = dimension == 2 ? std::pair<Vec3, Vec3>{Vec3(-c.normal.y(), c.normal.x(), 0), 0.18 * c.normal}
                                       : tangents(c.normal);
    for (int k = 0; k < sides; ++k) {
      const double t = 2 * pi * (k + 0.5) / sides, stretch = dimension == 2 ? std::sqrt(2.0) : 1.0;
      const Vec3 at = c.position + stretch * c.radius * (std::cos(t) * a + std::sin(t) * b);
      corner[std::size_t(k)] = points->InsertNextPoint(at.data());
    }
    faces->InsertNextCell(sides, corner.data());
    colours->InsertNextTypedTuple(c.colour.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(faces);
  data->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  add_actor(renderer, mapper, dimension == 2 ? 1.0 : 0.55, dimension == 2 ? 0.0 : 0.5, 0);
}

void add_outline(vtkRenderer* renderer, const SpecimenShape& s, int dimension, double line_width) {
  const Vec3 centre = s.base + 0.5 * s.height * s.axis;
  if (dimension == 2) {
    const Vec3 low = centre - 0.5 * s.extent, high = centre + 0.5 * s.extent;
    vtkNew<vtkPoints> points;
    for (const auto& [x, y] :
         {std::pair{low.x(), low.y()}, {low.x(), high.y()}, {high.x(), high.y()}, {high.x(), low.y()}})
      points->InsertNextPoint(x, y, 0);
    vtkNew<vtkCellArray> edges;
    insert_cell(edges, {0, 1, 2, 3, 0});
    add_edges(renderer, points, edges, line_width);
  } else if (s.outline == SpecimenShape::Outline::cylinder) {
    add_cylinder(renderer, s, line_width);
  } else {
    add_box(renderer, centre - 0.5 * s.extent, centre + 0.5 * s.extent, line_width);
  }
}

}  // namespace breccia::pictures
