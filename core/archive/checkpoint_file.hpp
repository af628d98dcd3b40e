// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint on the disk: one HDF5 file behind 512 bytes of text, which say what it is and what its bytes add up to.
///
/// HDF5's C interface is called as it is: its C++ interface is not kept up, and another library between would only
/// rename the ten functions that are needed. The library works in memory: what goes to the disk goes as all of
/// Breccia's files do, and what comes from there is checked before the library sees it (a damaged file can crash it).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "breccia/archive.hpp"

namespace breccia {

/// Writes: call it for all there is, then `commit`.
class CheckpointWriter final : public Archive {
 public:
  CheckpointWriter();
  ~CheckpointWriter() override;
  bool reading() const override { return false; }
  /// The file appears whole, with all its bytes on the disk. CannotWrite.
  void commit(const std::filesystem::path& file);

 private:
  void write(const std::string& path, archived::Element element, const void* data, std::size_t rows,
             std::size_t columns, std::size_t stride) override;
  std::size_t rows(const std::string&, archived::Element, std::size_t) override { return 0; }
  void read(const std::string&, archived::Element, void*, std::size_t, std::size_t, std::size_t) override {}
  void open(const std::string& group) override;
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override;

  std::int64_t file_ = -1;
};

/// Reads, in any order.
class CheckpointReader final : public Archive {
 public:
  /// UserError when there is no such file, or it is damaged or of another format.
  explicit CheckpointReader(std::filesystem::path file);
  ~CheckpointReader() override;
  bool reading() const override { return true; }
  const std::filesystem::path& file() const { return path_; }

 private:
  void write(const std::string&, archived::Element, const void*, std::size_t, std::size_t, std::size_t) override {}
  std::size_t rows(const std::string& path, archived::Element element, std::size_t columns) override;
  void read(const std::string& path, archived::Element element, void* data, std::size_t rows, std::size_t columns,
            std::size_t stride) override;
  void open(const std::string&) override {}
  [[noreturn]] void refuse(const std::string& path, const std::string& why) const override;

  std::filesystem::path path_;
  std::vector<char> image_;
  std::int64_t file_ = -1;
};

/// `step_000000012345.h5`, so that names sort as steps do.
std::string checkpoint_name(std::uint64_t step);
/// Those in the folder, newest first; none if there is no such folder.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

}  // namespace breccia
