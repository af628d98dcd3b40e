// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_region.hpp"

#ifdef BRECCIA_HAS_VTK
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>

#include "../../shared/checked_vtp_reader.hpp"
#endif

#include <cstdio>

#include "breccia/packing_tools/parallel.hpp"
#include "breccia/packing_tools/triangle_mesh.hpp"

namespace breccia::collective_rearrangement {

namespace {

constexpr int samples_per_side = 64;  // of the grid on which the volume of a grown mesh is counted
constexpr int confine_steps = 50;     // toward a place that keeps clear of several facets at once
constexpr int most_places = 10000;    // tried for one sphere

#ifdef BRECCIA_HAS_VTK
TriangleMesh read_vtp(const std::filesystem::path& file, double unit) {
  const vtkSmartPointer<vtkPolyData> read = vtk::read_vtp(file);
  if (!read) throw UserError("cannot read " + file.string() + ": it is missing, damaged, or no VTK poly data");
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(read);
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  vtkPolyData* surface = triangles->GetOutput();
  if (surface->GetNumberOfPolys() == 0) throw UserError("cannot read " + file.string() + ": it holds no triangles");
  TriangleMesh mesh;
  mesh.points.resize(std::size_t(surface->GetNumberOfPoints()));
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    surface->GetPoint(vtkIdType(k), mesh.points[k].data());
    mesh.points[k] *= unit;
  }
  vtkNew<vtkIdList> corners;
  for (surface->GetPolys()->InitTraversal(); surface->GetPolys()->GetNextCell(corners);)
    mesh.corners.push_back(
        {std::size_t(corners->GetId(0)), std::size_t(corners->GetId(1)), std::size_t(corners->GetId(2))});
  return mesh;
}
#endif

TriangleMesh read_triangles(const MeshConfig& config) {
  if (has_ending(config.file, ".stl")) return read_stl(config.file, config.length_unit);
#ifdef BRECCIA_HAS_VTK
  if (has_ending(config.file, ".vtp")) return read_vtp(config.file, config.length_unit);
#else
  if (has_ending(config.file, ".vtp"))
    throw UserError("reading " + config.file.string() +
                    " needs VTK, and this Breccia was built without it: convert it to .stl");
#endif
  throw UserError("cannot read " + config.file.string() + ": a mesh is read from .stl or .vtp");
}

class MeshRegion final : public Region {
 public:
  MeshRegion(std::shared_ptr<const ClosedSurface> surface, int threads, double margin = 0)
      : surface_(std::move(surface)),
        threads_(threads),
        margin_(margin),
        low_(surface_->low() - Vec3::Constant(margin)),
        high_(surface_->high() + Vec3::Constant(margin)),
        volume_(margin > 0 ? counted_volume() : surface_->volume()) {}

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
    const auto next = [](double& u, double step) {
      u += step;
      u -= std::floor(u);
    };
    for (int k = 0; k < most_places; ++k) {
      const Vec3 x = low_ + Vec3(a, b, c).cwiseProduct(high_ - low_);
      if (depth(x) > 0)
        if (const Confined p = confine(x, r, 0); p.room >= -1e-9 * r) return p.x;
      next(a, 0.8191725133961645);  // powers of the root of x^4 = x + 1: evenly spread in three dimensions
      next(b, 0.6710436067037893);
      next(c, 0.5497004779019703);
    }
    char text[120];
    std::snprintf(text, sizeof text, "no place was found in the mesh for a particle of radius %.4g m: use smaller ones",
                  r);
    throw UserError(text);
  }

  unsigned walls_near(const Vec3& x, double r, double gap) const override {
    return depth(x) <= (1 + gap) * r ? 1u : 0u;
  }

  /// From facet to facet, as long as one is too near.
  Confined confine(const Vec3& x, double r, unsigned touching) const override {
    Confined p{x, 0};
    Vec3 inward;
    p.room = depth(p.x, inward) - r;
    for (int k = 0; k < confine_steps && (p.room < -1e-9 * r || (touching && p.room > 1e-9 * r)); ++k) {
      p.x -= p.room * inward;
      p.room = depth(p.x, inward) - r;
    }
    return p;
  }

  double depth(const Vec3& x) const override {
    Vec3 ignored;
    return depth(x, ignored);
  }

  std::unique_ptr<Region> grown(double margin, bool) const override {
    return std::make_unique<MeshRegion>(surface_, threads_, margin_ + margin);
  }

 private:
  double depth(const Vec3& x, Vec3& inward) const { return margin_ + surface_->depth(x, inward); }

  double counted_volume() const {
    const Vec3 cell = (high_ - low_) / samples_per_side;
    const std::size_t layer = std::size_t(samples_per_side) * samples_per_side;
    const double inside = ordered_sum(layer * samples_per_side, threads_, [&](std::size_t k) {
      const Vec3 at(double(k % samples_per_side), double(k % layer / samples_per_side), double(k / layer));
      return depth(low_ + cell.cwiseProduct(at + Vec3::Constant(0.5))) > 0 ? 1.0 : 0.0;
    });
    return inside * cell.prod();
  }

  std::shared_ptr<const ClosedSurface> surface_;
  int threads_;
  double margin_;
  Vec3 low_, high_;
  double volume_;
};

}  // namespace

std::unique_ptr<Region> read_mesh(const MeshConfig& config, int threads) {
  return std::make_unique<MeshRegion>(
      std::make_shared<const ClosedSurface>(closed_surface(read_triangles(config), config.file)), threads);
}

}  // namespace breccia::collective_rearrangement
