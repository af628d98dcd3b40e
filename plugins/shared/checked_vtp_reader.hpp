// SPDX-License-Identifier: BSD-3-Clause
/// Poly data in VTK's XML, for the plugins that read it.
#pragma once

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <string_view>

namespace breccia::vtk {

/// VTK's reader takes what it meets in a file for what it expects, and a damaged one ends the program: what it does not
/// look at itself is looked at here, before it reads on.
class CheckedVtpReader : public vtkXMLPolyDataReader {
 public:
  static CheckedVtpReader* New() { VTK_STANDARD_NEW_BODY(CheckedVtpReader); }
  vtkTypeMacro(CheckedVtpReader, vtkXMLPolyDataReader);

 protected:
  int ReadVTKFile(vtkXMLDataElement* file) override {
    return is_sound(file) ? vtkXMLPolyDataReader::ReadVTKFile(file) : 0;
  }

 private:
  bool is_sound(vtkXMLDataElement* element) {
    const std::string_view name = element->GetName() ? element->GetName() : "";
    // VTK asks for memory by what a file says: of all its numbers of things, none can be more than fit into it packed.
    std::error_code unknown;
    const auto size = std::filesystem::file_size(GetFileName(), unknown);
    constexpr std::uintmax_t most_packed = 1100;  // numbers a byte, all zero: zlib reaches 1032
    for (const char* counted :
         {"NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys", "NumberOfTuples"})
      if (const char* said = element->GetAttribute(counted); said && !is_count(said, 0, most_packed * (size + 1)))
        return false;
    if ((name == "DataArray" || name == "Array") && !is_sound_array(element)) return false;
    for (int k = 0; k < element->GetNumberOfNestedElements(); ++k)
      if (!is_sound(element->GetNestedElement(k))) return false;
    return true;
  }

  static bool is_count(const char* said, std::uintmax_t least, std::uintmax_t most) {
    std::uintmax_t number = 0;
    const auto [end, error] = std::from_chars(said, said + std::strlen(said), number);
    return error == std::errc() && *end == '\0' && number >= least && number <= most;
  }

  static bool is_sound_array(vtkXMLDataElement* array) {
    static constexpr std::string_view types[] = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                                 "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
    // VTK would go through as many names of components as are asked for.
    constexpr int most_components = 1000;
    const char* said = array->GetAttribute("NumberOfComponents");
    if (said && !is_count(said, 1, most_components)) return false;
    const char* type = array->GetAttribute("type");
    return type && std::find(std::begin(types), std::end(types), type) != std::end(types);
  }
};

/// Null when the file is damaged or none of its kind. VTK's own words are not printed.
inline vtkSmartPointer<vtkPolyData> read_vtp(const std::filesystem::path& file) {
  bool bad = false;  // whatever VTK dislikes ends here; without observers it would print
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&bad);
  note->SetCallback([](vtkObject*, unsigned long, void* client, void*) { *static_cast<bool*>(client) = true; });
  vtkNew<CheckedVtpReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, note);
  reader->SetParserErrorObserver(note);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
  if (!reader->CanReadFile(file.c_str())) return nullptr;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (bad || reader->GetErrorCode() != 0) return nullptr;
  return reader->GetOutput();
}

}  // namespace breccia::vtk
