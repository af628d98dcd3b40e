// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_region.hpp"

#ifdef BRECCIA_HAS_VTK

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdio>
#include <sstream>

#include "breccia/packing_tools/parallel.hpp"
#include "breccia/text_file.hpp"
#include "surface.hpp"

namespace breccia::collective_rearrangement {

namespace {

constexpr int samples_per_side = 64;  // of the grid on which the volume of a grown mesh is counted
constexpr int confine_steps = 50;     // toward a place that keeps clear of several facets at once
constexpr int most_places = 10000;    // tried for one sphere

/// VTK takes a text with a byte order mark, or in UTF-16, for a binary file, and knows no lines that end in \r.
bool is_text_unknown_to_vtk(std::string_view start) {
  using namespace std::string_view_literals;
  if (start.starts_with("\xFF\xFE"sv) || start.starts_with("\xFE\xFF"sv) || start.starts_with("s\0o\0"sv) ||
      start.starts_with("\0s\0o"sv))
    return true;
  const std::string_view text = without_mark(start);
  if (!text.starts_with("solid")) return false;
  return text.size() < start.size() || (text.find('\r') != text.npos && text.find('\n') == text.npos);
}

/// All that counts are the words `vertex x y z`, three to a triangle.
vtkSmartPointer<vtkPolyData> read_stl_text(const std::string& text) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();  // as VTK's reader
  vtkNew<vtkCellArray> triangles;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    float x[3];
    if (!(words >> x[0] >> x[1] >> x[2])) break;
    const vtkIdType last = points->InsertNextPoint(x);
    const vtkIdType corners[] = {last - 2, last - 1, last};
    if (last % 3 == 2) triangles->InsertNextCell(3, corners);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

vtkSmartPointer<vtkPolyData> read_surface(const std::filesystem::path& file) {
  const std::string start = read_bytes(file, 512);
  const bool stl = has_ending(file, ".stl"), vtp = has_ending(file, ".vtp");
  const bool warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOff();  // VTK would print its own words; an empty surface tells enough
  vtkSmartPointer<vtkPolyData> surface;
  if (stl && is_text_unknown_to_vtk(start)) {
    surface = read_stl_text(read_text_file(file));
  } else if (stl) {
    vtkNew<vtkSTLReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    surface = reader->GetOutput();
  } else if (vtp) {
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
  MeshRegion(std::shared_ptr<const Surface> surface, int threads, double margin = 0)
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

  std::shared_ptr<const Surface> surface_;
  int threads_;
  double margin_;
  Vec3 low_, high_;
  double volume_;
};

}  // namespace

std::unique_ptr<Region> read_mesh(const MeshConfig& config, int threads) {
  const auto mesh = prepared(read_surface(config.file), config.length_unit);
  refuse_open(mesh, config.file);
  std::vector<Vec3> points(std::size_t(mesh->GetNumberOfPoints()));
  for (std::size_t k = 0; k < points.size(); ++k) mesh->GetPoint(vtkIdType(k), points[k].data());
  std::vector<Surface::Triangle> triangles;
  vtkNew<vtkIdList> corners;
  for (mesh->GetPolys()->InitTraversal(); mesh->GetPolys()->GetNextCell(corners);)
    triangles.push_back(
        {std::size_t(corners->GetId(0)), std::size_t(corners->GetId(1)), std::size_t(corners->GetId(2))});
  if (triangles.empty()) throw UserError("cannot read " + config.file.string() + ": all its triangles are degenerate");
  return std::make_unique<MeshRegion>(std::make_shared<const Surface>(std::move(points), std::move(triangles)),
                                      threads);
}

}  // namespace breccia::collective_rearrangement

#else

namespace breccia::collective_rearrangement {

std::unique_ptr<Region> read_mesh(const MeshConfig&, int) {
  throw UserError("packing into a mesh needs VTK, and this Breccia was built without it: use a container");
}

}  // namespace breccia::collective_rearrangement

#endif
