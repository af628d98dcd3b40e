// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_region.hpp"

#ifdef BRECCIA_HAS_VTK

#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <fstream>

namespace breccia::collective_rearrangement {

namespace {

constexpr int samples_per_side = 64;   // of the grid on which the volume of a grown mesh is counted
constexpr int confine_steps = 8;       // toward a place that keeps clear of several facets at once

vtkSmartPointer<vtkPolyData> read_surface(const std::filesystem::path& file) {
  if (!std::ifstream(file)) throw UserError("cannot read " + file.string() + ": no such file, or no permission");
  const bool warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();   // VTK would print its own words; an empty surface tells enough
  vtkSmartPointer<vtkPolyData> surface;
  std::string ending = file.extension().string();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".stl") {
    vtkNew<vtkSTLReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    surface = reader->GetOutput();
  } else if (ending == ".vtp") {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    surface = reader->GetOutput();
  }
  vtkObject::SetGlobalWarningDisplay(warnings);
  if (!surface) throw UserError("cannot read " + file.string() + ": a mesh is read from .stl or .vtp");
  if (surface->GetNumberOfPolys() == 0) throw UserError("cannot read " + file.string() + ": it holds no triangles");
  return surface;
}

/// Triangles in metres, shared points merged, normals outward.
vtkSmartPointer<vtkPolyData> prepared(vtkPolyData* surface, double unit) {
  vtkNew<vtkTransform> scale;
  scale->Scale(unit, unit, unit);
  vtkNew<vtkTransformPolyDataFilter> scaled;
  scaled->SetInputData(surface);
  scaled->SetTransform(scale);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(scaled->GetOutputPort());
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(clean->GetOutputPort());
  normals->ConsistencyOn();
  normals->AutoOrientNormalsOn();
  normals->SplittingOff();
  normals->Update();
  return normals->GetOutput();
}

void refuse_open(vtkPolyData* surface, const std::filesystem::path& file) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->Update();
  if (const auto open = edges->GetOutput()->GetNumberOfLines(); open > 0)
    throw UserError("the surface of " + file.string() + " is not closed: " + std::to_string(open) +
                    " of its edges do not join exactly two triangles");
}

class MeshRegion final : public Region {
 public:
  explicit MeshRegion(vtkSmartPointer<vtkPolyData> surface) : surface_(std::move(surface)) {
    distance_->SetInput(surface_);
    vtkNew<vtkMassProperties> mass;
    mass->SetInputData(surface_);
    mass->Update();
    volume_ = mass->GetVolume();
    set_bounds();
  }

  double measure() const override { return volume_; }
  double largest_radius() const override { return 0.5 * (high_ - low_).minCoeff(); }
  SpecimenShape::Outline outline() const override { return SpecimenShape::Outline::irregular; }
  Vec3 axis() const override {
    int at = 2;
    for (int k = 1; k >= 0; --k)
      if ((high_ - low_)[k] > (high_ - low_)[at]) at = k;
    return Vec3::Unit(at);
  }

  /// The bounding box is searched with a sequence that follows from the three numbers, so that equal numbers give
  /// equal places.
  Vec3 place(double r, double a, double b, double c) const override {
    const auto next = [](double& u, double step) { u += step; u -= std::floor(u); };
    Vec3 x = low_;
    for (int k = 0; k < 10000; ++k) {
      x = low_ + Vec3(a, b, c).cwiseProduct(high_ - low_);
      if (depth(x) > 0) break;
      next(a, 0.8191725133961645);   // powers of the root of x^4 = x + 1: evenly spread in three dimensions
      next(b, 0.6710436067037893);
      next(c, 0.5497004779019703);
    }
    return confine(x, r, 0);
  }

  unsigned walls_near(const Vec3& x, double r, double gap) const override { return depth(x) <= (1 + gap) * r ? 1u : 0u; }

  Vec3 confine(const Vec3& x, double r, unsigned touching) const override {
    Vec3 p = x;
    for (int k = 0; k < confine_steps; ++k) {
      Vec3 inward;
      const double missing = r - depth(p, inward);
      if (missing <= 1e-9 * r && (!touching || missing >= -1e-9 * r)) break;
      p += missing * inward;
    }
    return p;
  }

  double depth(const Vec3& x) const override {
    Vec3 ignored;
    return depth(x, ignored);
  }

  std::unique_ptr<Region> grown(double margin, bool) const override {
    auto copy = std::make_unique<MeshRegion>(surface_);
    copy->margin_ = margin_ + margin;
    copy->set_bounds();
    copy->count_volume();
    return copy;
  }

 private:
  /// VTK's distance is positive outside; its gradient points away from the surface.
  double depth(const Vec3& x, Vec3& inward) const {
    Vec3 at = x, gradient;
    double value;
#pragma omp critical(breccia_mesh_distance)   // the function keeps buffers
    {
      value = distance_->EvaluateFunction(at.data());
      distance_->EvaluateGradient(at.data(), gradient.data());
    }
    inward = -gradient.normalized();
    return margin_ - value;
  }

  void set_bounds() {
    double b[6];
    surface_->GetBounds(b);
    low_ = Vec3(b[0], b[2], b[4]) - Vec3::Constant(margin_);
    high_ = Vec3(b[1], b[3], b[5]) + Vec3::Constant(margin_);
  }

  void count_volume() {
    const Vec3 cell = (high_ - low_) / samples_per_side;
    std::size_t inside = 0;
    for (int c = 0; c < samples_per_side; ++c)
      for (int b = 0; b < samples_per_side; ++b)
        for (int a = 0; a < samples_per_side; ++a)
          inside += depth(low_ + cell.cwiseProduct(Vec3(a + 0.5, b + 0.5, c + 0.5))) > 0;
    volume_ = double(inside) * cell.prod();
  }

  vtkSmartPointer<vtkPolyData> surface_;
  vtkNew<vtkImplicitPolyDataDistance> distance_;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  double volume_ = 0, margin_ = 0;
};

}  // namespace

std::unique_ptr<Region> read_mesh(const MeshConfig& config) {
  const auto surface = prepared(read_surface(config.file), config.length_unit);
  refuse_open(surface, config.file);
  return std::make_unique<MeshRegion>(surface);
}

}  // namespace breccia::collective_rearrangement

#else

namespace breccia::collective_rearrangement {

std::unique_ptr<Region> read_mesh(const MeshConfig&) {
  throw UserError("packing into a mesh needs VTK, and this Breccia was built without it: use a container");
}

}  // namespace breccia::collective_rearrangement

#endif
