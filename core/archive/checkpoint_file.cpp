// SPDX-License-Identifier: BSD-3-Clause
#include "archive/checkpoint_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "archive/hdf5_library.hpp"

namespace breccia {
namespace fs = std::filesystem;

std::unique_ptr<CheckpointWriter> begin_checkpoint(std::size_t bytes) {
  hdf5_needs_memory(bytes);
  return std::unique_ptr<CheckpointWriter>(
      hdf5_function<CheckpointWriter*(std::size_t)>("breccia_begin_checkpoint")(bytes));
}

std::unique_ptr<CheckpointReader> read_checkpoint(const fs::path& file) {
  std::error_code unknown;
  const auto size = fs::file_size(file, unknown);
  hdf5_needs_memory(unknown ? 0 : std::size_t(size));
  return std::unique_ptr<CheckpointReader>(
      hdf5_function<CheckpointReader*(const char*)>("breccia_read_checkpoint")(file.c_str()));
}

std::string checkpoint_name(std::uint64_t step) { return fmt::format("step_{:012}.h5", step); }

std::vector<fs::path> checkpoints_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with("step_") && name.ends_with(".h5")) found.push_back(at->path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

}  // namespace breccia
