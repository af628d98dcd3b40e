// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_region.hpp"

#ifdef BRECCIA_HAS_VTK

#include <omp.h>
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

#include <cstdio>
#include <fstream>

#include "breccia/packing_tools/parallel.hpp"

namespace breccia::collective_rearrangement {

namespace {

constexpr int samples_per_side = 64;   // of the grid on which the volume of a grown mesh is counted
constexpr int confine_steps = 50;      // toward a place that keeps clear of several facets at once
constexpr int most_places = 10000;     // tried for one sphere

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
  MeshRegion(vtkSmartPointer<vtkPolyData> surface, int threads, double margin = 0)
      : surface_(std::move(surface)), margin_(margin) {
    // VTK's function and its data keep buffers: each thread has its own.
    for (int k = 0; k < threads; ++k) {
      vtkNew<vtkPolyData> own;
      own->DeepCopy(surface_);
      distance_.push_back(vtkSmartPointer<vtkImplicitPolyDataDistance>::New());
      distance_.back()->SetInput(own);
    }
    double b[6];
    surface_->GetBounds(b);
    low_ = Vec3(b[0], b[2], b[4]) - Vec3::Constant(margin_);
    high_ = Vec3(b[1], b[3], b[5]) + Vec3::Constant(margin_);
    volume_ = margin_ > 0 ? counted_volume() : enclosed_volume();
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
    for (int k = 0; k < most_places; ++k) {
      const Vec3 x = low_ + Vec3(a, b, c).cwiseProduct(high_ - low_);
      if (depth(x) > 0)
        if (const Confined p = confine(x, r, 0); p.room >= -1e-9 * r) return p.x;
      next(a, 0.8191725133961645);   // powers of the root of x^4 = x + 1: evenly spread in three dimensions
      next(b, 0.6710436067037893);
      next(c, 0.5497004779019703);
    }
    char text[120];
    std::snprintf(text, sizeof text, "no place was found in the mesh for a particle of radius %.4g m: use smaller ones", r);
    throw UserError(text);
  }

  unsigned walls_near(const Vec3& x, double r, double gap) const override { return depth(x) <= (1 + gap) * r ? 1u : 0u; }

  /// From facet to facet, as long as one is too near.
  Confined confine(const Vec3& x, double r, unsigned touching) const override {
    Confined p{x, 0};
    Vec3 inward;
    p.room = depth(p.x, &inward) - r;
    for (int k = 0; k < confine_steps && (p.room < -1e-9 * r || (touching && p.room > 1e-9 * r)); ++k) {
      p.x -= p.room * inward;
      p.room = depth(p.x, &inward) - r;
    }
    return p;
  }

  double depth(const Vec3& x) const override { return depth(x, nullptr); }

  std::unique_ptr<Region> grown(double margin, bool) const override {
    return std::make_unique<MeshRegion>(surface_, int(distance_.size()), margin_ + margin);
  }

 private:
  /// VTK's distance is positive outside; its gradient points away from the surface.
  double depth(const Vec3& x, Vec3* inward) const {
    vtkImplicitPolyDataDistance* distance = distance_[std::size_t(omp_get_thread_num())];
    Vec3 at = x, nearest;
    const double value = distance->EvaluateFunctionAndGetClosestPoint(at.data(), nearest.data());
    if (inward) {
      *inward = (nearest - x) / value;
      if (!(std::abs(inward->norm() - 1) < 1e-3)) {   // on the surface itself, where the difference is rounding
        distance->EvaluateGradient(at.data(), inward->data());
        *inward = -inward->normalized();
      }
    }
    return margin_ - value;
  }

  double enclosed_volume() const {
    vtkNew<vtkMassProperties> mass;
    mass->SetInputData(surface_);
    mass->Update();
    return mass->GetVolume();
  }

  double counted_volume() const {
    const Vec3 cell = (high_ - low_) / samples_per_side;
    const std::size_t layer = std::size_t(samples_per_side) * samples_per_side;
    const double inside = ordered_sum(layer * samples_per_side, int(distance_.size()), [&](std::size_t k) {
      const Vec3 at(double(k % samples_per_side), double(k % layer / samples_per_side), double(k / layer));
      return depth(low_ + cell.cwiseProduct(at + Vec3::Constant(0.5))) > 0 ? 1.0 : 0.0;
    });
    return inside * cell.prod();
  }

  vtkSmartPointer<vtkPolyData> surface_;
  std::vector<vtkSmartPointer<vtkImplicitPolyDataDistance>> distance_;   // by thread
  double margin_ = 0, volume_ = 0;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

}  // namespace

std::unique_ptr<Region> read_mesh(const MeshConfig& config, int threads) {
  const auto surface = prepared(read_surface(config.file), config.length_unit);
  refuse_open(surface, config.file);
  return std::make_unique<MeshRegion>(surface, threads);
}

}  // namespace breccia::collective_rearrangement

#else

namespace breccia::collective_rearrangement {

std::unique_ptr<Region> read_mesh(const MeshConfig&, int) {
  throw UserError("packing into a mesh needs VTK, and this Breccia was built without it: use a container");
}

}  // namespace breccia::collective_rearrangement

#endif
