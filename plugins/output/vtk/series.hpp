// SPDX-License-Identifier: BSD-3-Clause
/// A time series of VTK files and the ParaView collection (.pvd) that lists them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "breccia/archive.hpp"
#include "breccia/views.hpp"

class vtkPolyData;

namespace breccia::vtk_output {

/// `NAME_000000.vtp`, `NAME_000001.vtp`, ... and `NAME.pvd`. Every file gets its final name only when it is whole; the
/// collection is renewed after each frame, so that an interrupted run can be read.
class Series {
 public:
  /// `shared`: by several ranks, of which the first alone may write or remove more than its own piece.
  Series(std::filesystem::path directory, std::string name, bool shared);

  /// Writes one frame and lists it. Frames of an earlier run in the same folder that lie before `time` [s] of the first
  /// frame stay listed (a resumed run), others are dropped. UserError, naming the file, when the disk refuses.
  void append(vtkPolyData* data, double time);
  /// The same of all ranks together: each writes its piece, `NAME_000000_0.vtp` and so on, and when these are whole the
  /// first writes `NAME_000000.pvtp`, which the collection lists.
  void append_piece(vtkPolyData* data, const SimulationView& view);
  /// What is read leads to a folder in which frames were written after the checkpoint: these are removed, of a shared
  /// series before the next one is written.
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
  void begin(double time);
  void cut_back();
  void write_collection() const;
  void write_pieces(vtkPolyData* data, int count) const;
  std::string frame_name(std::size_t number) const;
  std::string piece_name(std::size_t number, int piece) const;
  std::optional<std::size_t> number_of(const std::string& file) const;

  std::filesystem::path directory_;
  std::string name_;
  std::vector<Entry> entries_;
  bool started_ = false, shared_, behind_ = false;  ///< there may be frames behind the last entry
};

}  // namespace breccia::vtk_output
