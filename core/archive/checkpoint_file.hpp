// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint on the disk: one HDF5 file behind 512 bytes of text, which say what it is and what its bytes add up to.
///
/// HDF5's C interface is called as it is: its C++ interface is not kept up, and another library between would only
/// rename the ten functions that are needed. The library works in memory: what goes to the disk goes as all of
/// Breccia's files do, and what comes from there is checked before the library sees it (a damaged file can crash it).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "breccia/archive.hpp"

namespace breccia {

/// Writes: call it for all there is, then `commit`.
class BRECCIA_API CheckpointWriter : public Archive {
 public:
  bool reading() const final { return false; }
  /// The file appears whole, with all its bytes on the disk. CannotWrite.
  virtual void commit(const std::filesystem::path& file) = 0;
};

/// Reads, in any order.
class BRECCIA_API CheckpointReader : public Archive {
 public:
  bool reading() const final { return true; }
  virtual const std::filesystem::path& file() const = 0;
};

/// UserError where the library cannot be loaded (`breccia-core/breccia_checkpoint_hdf5.so` beside the plugins' folder).
/// std::bad_alloc when there is no memory for a file of so many bytes: the library is not entered then, as it may
/// crash.
std::unique_ptr<CheckpointWriter> begin_checkpoint(std::size_t bytes = 0);
/// The same, and UserError when there is no such file, or it is damaged or of another format.
std::unique_ptr<CheckpointReader> read_checkpoint(const std::filesystem::path& file);

/// `step_000000012345.h5`, so that names sort as steps do.
std::string checkpoint_name(std::uint64_t step);
/// Those in the folder, newest first; none if there is no such folder.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

}  // namespace breccia
