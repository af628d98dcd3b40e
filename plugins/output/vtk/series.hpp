// SPDX-License-Identifier: BSD-3-Clause
/// A time series of VTK files and the ParaView collection (.pvd) that lists them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "breccia/archive.hpp"

class vtkPolyData;

namespace breccia::vtk_output {

/// `NAME_000000.vtp`, `NAME_000001.vtp`, ... and `NAME.pvd`. Every file gets its final name only when it is whole; the
/// collection is renewed after each frame, so that an interrupted run can be read.
class Series {
 public:
  Series(std::filesystem::path directory, std::string name);

  /// Writes one frame and lists it. Frames of an earlier run in the same folder that lie before `time` [s] of the first
  /// frame stay listed (a resumed run), others are dropped. UserError, naming the file, when the disk refuses.
  void append(vtkPolyData* data, double time);
  /// What is read leads to a folder in which frames were written after the checkpoint: these are removed.
  void archive(Archive& archive);

 private:
  struct Entry {
    double time = 0;
    std::string file;
    void archive(Archive& archive) {
      archive("time", time);
      archive("file", file);
    }
  };
  void resume(double time);
  void write_collection() const;
  std::string file_name(std::size_t number) const;

  std::filesystem::path directory_;
  std::string name_;
  std::vector<Entry> entries_;
  bool started_ = false;
};

}  // namespace breccia::vtk_output
