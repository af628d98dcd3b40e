// SPDX-License-Identifier: BSD-3-Clause
#include "series.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUtilities.h>

#include <charconv>

#include "breccia/atomic_file.hpp"

namespace breccia::vtk_output {
namespace fs = std::filesystem;
namespace {

/// Shortest text that reads back as the same number.
std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void write_poly_data(vtkPolyData* data, const fs::path& file) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  // Errors are reported below: an observer keeps VTK from printing its own text.
  vtkNew<vtkCallbackCommand> silent;
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent);
  writer->SetInputData(data);
  writer->SetDataModeToBinary();  // inline: ParaView 5.11 with a recent libexpat cannot read appended data
  writer->SetCompressorTypeToLZ4();
  writer->WriteToOutputStringOn();  // to memory: its destructor crashes after a disk was full
  const bool wrote = writer->Write() != 0;
  const unsigned long code = writer->GetErrorCode();
  if (!wrote || code != vtkErrorCode::NoError)
    throw UserError("output vtk: cannot write " + file.string() + ": " + vtkErrorCode::GetStringFromErrorCode(code));
  write_file(file, writer->GetOutputString());
}

}  // namespace

Series::Series(fs::path directory, std::string name, bool shared)
    : directory_(std::move(directory)), name_(std::move(name)), shared_(shared) {}

void Series::resume(double time) {
  const fs::path collection = directory_ / (name_ + ".pvd");
  if (!fs::exists(collection)) return;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(collection.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  for (int k = 0; list && k < list->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement* e = list->GetNestedElement(k);
    double at = 0;
    const char* file = e->GetAttribute("file");
    if (!file || !e->GetScalarAttribute("timestep", at) || at >= time) break;
    entries_.push_back({at, file});
  }
}

void Series::begin(double time) {
  if (!started_) resume(time);
  started_ = true;
}

void Series::append(vtkPolyData* data, double time) {
  if (behind_) cut_back();
  begin(time);
  const std::string file = frame_name(entries_.size()) + ".vtp";
  write_poly_data(data, directory_ / file);
  entries_.push_back({time, file});
  write_collection();
}

void Series::append_piece(vtkPolyData* data, const SimulationView& view) {
  const int piece = view.part ? view.part->number : 0, count = view.part ? view.part->count : 1;
  if (behind_ && piece == 0) cut_back();
  behind_ = false;
  (void)view.max(0);  // all wait until that is done
  begin(view.time);
  const std::size_t number = entries_.size();
  write_poly_data(data, directory_ / piece_name(number, piece));
  (void)view.max(0);  // until all pieces are whole
  entries_.push_back({view.time, frame_name(number) + ".pvtp"});
  if (piece != 0) return;
  write_pieces(data, count);
  write_collection();
}

std::string Series::frame_name(std::size_t number) const {
  std::string count = std::to_string(number);
  if (count.size() < 6) count.insert(0, 6 - count.size(), '0');
  return name_ + "_" + count;
}

std::string Series::piece_name(std::size_t number, int piece) const {
  return frame_name(number) + "_" + std::to_string(piece) + ".vtp";
}

void Series::archive(Archive& archive) {
  archive("entries", entries_);
  archive("started", started_);
  if (!archive.reading()) return;
  behind_ = true;
  if (!shared_) cut_back();
}

/// Of a frame, or of a piece of one; none of what is no file of this series.
std::optional<std::size_t> Series::number_of(const std::string& file) const {
  if (!file.starts_with(name_ + "_")) return {};
  std::size_t number = 0;
  const char* const end = file.data() + file.size();
  const auto read = std::from_chars(file.data() + name_.size() + 1, end, number);
  if (read.ec != std::errc()) return {};
  const std::string frame = frame_name(number);
  if (file == frame + ".vtp" || file == frame + ".pvtp") return number;
  int piece = 0;
  if (read.ptr == end || *read.ptr != '_' || std::from_chars(read.ptr + 1, end, piece).ec != std::errc()) return {};
  return file == piece_name(number, piece) ? std::optional(number) : std::nullopt;
}

/// Frames behind the last entry, in whatever pieces.
void Series::cut_back() {
  behind_ = false;
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory_, error))
    if (const auto number = number_of(entry.path().filename().string()); number && *number >= entries_.size())
      files.push_back(entry.path());
  for (const fs::path& file : files) fs::remove(file, error);
  if (!entries_.empty()) write_collection();
  else fs::remove(directory_ / (name_ + ".pvd"), error);
}

void Series::write_pieces(vtkPolyData* data, int count) const {
  const auto array = [](vtkDataArray* of, const char* name) {
    const int type = of->GetDataType();
    const char* const known = type == VTK_FLOAT            ? "Float32"
                              : type == VTK_DOUBLE         ? "Float64"
                              : type == VTK_UNSIGNED_CHAR  ? "UInt8"
                              : of->GetDataTypeSize() == 4 ? "Int32"
                                                           : "Int64";
    return std::string("      <PDataArray type=\"") + known + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           std::to_string(of->GetNumberOfComponents()) + "\"/>\n";
  };
  const auto arrays = [&](const char* kind, vtkFieldData* of) {
    std::string text = std::string("    <") + kind + ">\n";
    for (int k = 0; k < of->GetNumberOfArrays(); ++k)
      if (vtkDataArray* const a = of->GetArray(k)) text += array(a, a->GetName());
    return text + "    </" + kind + ">\n";
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <PPolyData GhostLevel=\"0\">\n" +
      arrays("PPointData", data->GetPointData()) + arrays("PCellData", data->GetCellData()) + "    <PPoints>\n" +
      array(data->GetPoints()->GetData(), "Points") + "    </PPoints>\n";
  const std::size_t number = entries_.size() - 1;
  for (int piece = 0; piece < count; ++piece) text += "    <Piece Source=\"" + piece_name(number, piece) + "\"/>\n";
  write_file(directory_ / (frame_name(number) + ".pvtp"), text + "  </PPolyData>\n</VTKFile>\n");
}

void Series::write_collection() const {
  const fs::path file = directory_ / (name_ + ".pvd");
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Entry& e : entries_)
    text += "    <DataSet timestep=\"" + number(e.time) + "\" part=\"0\" file=\"" + e.file + "\"/>\n";
  write_file(file, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace breccia::vtk_output
