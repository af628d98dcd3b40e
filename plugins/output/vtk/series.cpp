// SPDX-License-Identifier: BSD-3-Clause
#include "series.hpp"

#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
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

Series::Series(fs::path directory, std::string name) : directory_(std::move(directory)), name_(std::move(name)) {}

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

void Series::append(vtkPolyData* data, double time) {
  if (!started_) resume(time);
  started_ = true;
  const std::string file = file_name(entries_.size());
  write_poly_data(data, directory_ / file);
  entries_.push_back({time, file});
  write_collection();
}

std::string Series::file_name(std::size_t number) const {
  std::string count = std::to_string(number);
  if (count.size() < 6) count.insert(0, 6 - count.size(), '0');
  return name_ + "_" + count + ".vtp";
}

void Series::archive(Archive& archive) {
  archive("entries", entries_);
  archive("started", started_);
  if (!archive.reading()) return;
  std::error_code error;
  for (std::size_t k = entries_.size(); fs::remove(directory_ / file_name(k), error); ++k) continue;
  if (!entries_.empty()) write_collection();
  else fs::remove(directory_ / (name_ + ".pvd"), error);
}

void Series::write_collection() const {
  const fs::path file = directory_ / (name_ + ".pvd");
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const Entry& e : entries_)
    text += "    <DataSet timestep=\"" + number(e.time) + "\" part=\"0\" file=\"" + e.file + "\"/>\n";
  write_file(file, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace breccia::vtk_output
