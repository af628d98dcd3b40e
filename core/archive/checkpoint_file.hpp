// SPDX-License-Identifier: BSD-3-Clause
/// A checkpoint on the disk: one HDF5 file behind 512 bytes of text, which say what it is and what its bytes add up to.
///
/// HDF5's C interface is called as it is: its C++ interface is not kept up, and another library between would only
/// rename the ten functions that are needed. One rank's file is made in memory, and goes to the disk as all of
/// Breccia's files do; several write theirs together, each its share. What comes from the disk is checked before the
/// library sees it (a damaged file can crash it).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "breccia/archive.hpp"
#include "engine/rank_link.hpp"

namespace breccia {

/// Writes: call it for all there is, then `commit`.
class BRECCIA_API CheckpointWriter : public Archive {
 public:
  bool reading() const final { return false; }
  /// The file appears whole, with all its bytes on the disk. CannotWrite.
  virtual void commit(const std::filesystem::path& file) = 0;
};

/// Reads, in any order, all of a list or a share.
class BRECCIA_API CheckpointReader : public Archive, public SharedLists {
 public:
  bool reading() const final { return true; }
  virtual const std::filesystem::path& file() const = 0;
};

/// UserError where the library cannot be loaded (`breccia-core/breccia_checkpoint_hdf5.so` beside the plugins' folder).
/// std::bad_alloc when there is no memory for a file of so many bytes: the library is not entered then, as it may
/// crash.
std::unique_ptr<CheckpointWriter> begin_checkpoint(std::size_t bytes = 0);
/// Of a specimen in parts, by all ranks together: of `SharedLists` each gives its share, of all else the first gives
/// it. Committed to the same name; `bytes`: of all ranks, for which there must be room on the disk. What fails does so
/// on all ranks, as UserError. While it stands it has a file `NAME.arriving`.
std::unique_ptr<CheckpointWriter> begin_checkpoint(RankLink& link, const std::filesystem::path& file,
                                                   std::size_t bytes);
/// UserError as above, and when there is no such file, or it is damaged or of another format. `link`: of ranks that
/// open it together, each of which looks at its share of the bytes: what is wrong is so on all of them. Else null.
std::unique_ptr<CheckpointReader> read_checkpoint(const std::filesystem::path& file, RankLink* link = nullptr);

/// `step_000000012345.h5`, so that names sort as steps do.
std::string checkpoint_name(std::uint64_t step);
/// Those in the folder, newest first; none if there is no such folder.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& folder);

}  // namespace breccia
