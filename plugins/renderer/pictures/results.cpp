// SPDX-License-Identifier: BSD-3-Clause
#include "results.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>

#include "../../shared/frame_pieces.hpp"
#include "breccia/error.hpp"

namespace breccia::pictures {
namespace fs = std::filesystem;
namespace {

/// VTK's XML parser prints what it dislikes; the messages of this plugin are enough.
class Quiet {
 public:
  Quiet() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~Quiet() { vtkObject::SetGlobalWarningDisplay(before_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int before_;
};

std::vector<fs::path> read_collection(const fs::path& file) {
  const Quiet quiet;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!list) throw UserError("renderer pictures: " + file.string() + " is not a ParaView collection (.pvd)");
  std::vector<fs::path> frames;
  for (int k = 0; k < list->GetNumberOfNestedElements(); ++k)
    if (const char* name = list->GetNestedElement(k)->GetAttribute("file")) frames.push_back(file.parent_path() / name);
  if (frames.empty()) throw UserError("renderer pictures: " + file.string() + " lists no frames");
  return frames;
}

std::optional<Vec3> vector_fact(vtkPolyData* frame, const char* name) {
  vtkDataArray* a = frame->GetFieldData()->GetArray(name);
  if (!a || a->GetNumberOfComponents() != 3 || a->GetNumberOfTuples() < 1) return {};
  Vec3 v;
  a->GetTuple(0, v.data());
  return v;
}

std::optional<double> number_fact(vtkPolyData* frame, const char* name) {
  vtkDataArray* a = frame->GetFieldData()->GetArray(name);
  if (!a || a->GetNumberOfComponents() != 1 || a->GetNumberOfTuples() < 1) return {};
  return a->GetTuple1(0);
}

}  // namespace

RunResults find_results(const fs::path& source) {
  RunResults r;
  if (fs::is_directory(source)) {
    if (fs::exists(source / "particles.pvd")) r.particle_frames = read_collection(source / "particles.pvd");
    if (fs::exists(source / "bonds.pvd")) r.bond_frames = read_collection(source / "bonds.pvd");
    if (fs::exists(source / "walls.pvd")) r.wall_frames = read_collection(source / "walls.pvd");
    if (fs::exists(source / "curves.csv")) r.curves = source / "curves.csv";
    if (fs::is_directory(source / "tables"))
      for (const auto& entry : fs::directory_iterator(source / "tables"))
        if (entry.path().extension() == ".csv") r.tables.push_back(entry.path());
    std::sort(r.tables.begin(), r.tables.end());
    if (r.particle_frames.empty() && r.bond_frames.empty() && r.curves.empty() && r.tables.empty())
      throw UserError("renderer pictures: " + source.string() +
                      " holds no results: neither particles.pvd nor bonds.pvd nor "
                      "curves.csv nor tables are there");
    return r;
  }
  if (!fs::exists(source)) throw UserError("renderer pictures: " + source.string() + " does not exist");
  std::vector<fs::path> frames;
  if (source.extension() == ".pvd") frames = read_collection(source);
  else if (source.extension() == ".vtp" || source.extension() == ".pvtp") frames = {source};
  else
    throw UserError("renderer pictures: " + source.string() +
                    " is neither a result folder nor a .pvd, .vtp or .pvtp file");
  const auto first = read_frame(frames.front());
  const bool bonds = first->GetCellData()->HasArray("break_position");
  (bonds ? r.bond_frames : r.particle_frames) = frames;
  return r;
}

vtkSmartPointer<vtkPolyData> read_frame(const fs::path& file) {
  const auto frame = vtk::read_frame(file);
  if (!frame)
    throw UserError("renderer pictures: cannot read " + file.string() +
                    ": it is missing, damaged, or no VTK poly data");
  return frame;
}

FrameFacts facts_of(vtkPolyData* frame) {
  FrameFacts f;
  f.time = number_fact(frame, "TimeValue");
  f.dimension = int(number_fact(frame, "dimension").value_or(3));
  const auto base = vector_fact(frame, "specimen_base"), axis = vector_fact(frame, "specimen_axis"),
             extent = vector_fact(frame, "specimen_extent");
  const auto height = number_fact(frame, "specimen_height");
  if (auto* names = vtkStringArray::SafeDownCast(frame->GetFieldData()->GetAbstractArray("material_names")))
    for (vtkIdType m = 0; m < names->GetNumberOfValues(); ++m) f.materials.push_back(names->GetValue(m));
  if (!base || !axis || !extent || !height || !(*height > 0)) return f;
  auto* outline = vtkStringArray::SafeDownCast(frame->GetFieldData()->GetAbstractArray("specimen_outline"));
  SpecimenShape s;
  // What the file does not name has an outline that we do not know: none is drawn.
  const std::string name = outline && outline->GetNumberOfValues() == 1 ? outline->GetValue(0) : "";
  using Outline = SpecimenShape::Outline;
  s.outline = Outline::irregular;
  if (name == "cylinder") s.outline = Outline::cylinder;
  if (name == "box") s.outline = Outline::box;
  if (name == "ellipsoid") s.outline = Outline::ellipsoid;
  s.base = *base;
  s.axis = *axis;
  s.extent = *extent;
  s.height = *height;
  f.specimen = s;
  return f;
}

}  // namespace breccia::pictures
