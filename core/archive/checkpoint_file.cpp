// SPDX-License-Identifier: BSD-3-Clause
#include "archive/checkpoint_file.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <new>

namespace breccia {
namespace fs = std::filesystem;

namespace {

/// Loaded when first asked for, and kept.
void* library() {
  static void* const loaded = [] {
    std::error_code unknown;
    const fs::path program = boost::dll::program_location(unknown).parent_path(),
                   file = (program / "../lib/breccia-core/breccia_checkpoint_hdf5.so").lexically_normal();
    void* const opened = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!opened)
      throw UserError(fmt::format("checkpoints need {}, which cannot be loaded: {}", file.string(), dlerror()));
    return opened;
  }();
  return loaded;
}

template <class F>
F* function(const char* name) {
  void* const found = dlsym(library(), name);
  BRECCIA_ASSERT(found);
  return reinterpret_cast<F*>(found);
}

/// HDF5 does not survive that memory ends while it is at work. It holds a file twice while that grows, in steps of up
/// to 4 MB, and gives it out once more; the rest is for the library itself.
void refuse_without_memory(std::size_t bytes) {
  const std::size_t size = 4 * bytes + (std::size_t(24) << 20);
  void* const all = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  munmap(all, size);
}

}  // namespace

std::unique_ptr<CheckpointWriter> begin_checkpoint(std::size_t bytes) {
  refuse_without_memory(bytes);
  return std::unique_ptr<CheckpointWriter>(function<CheckpointWriter*(std::size_t)>("breccia_begin_checkpoint")(bytes));
}

std::unique_ptr<CheckpointReader> read_checkpoint(const fs::path& file) {
  std::error_code unknown;
  const auto size = fs::file_size(file, unknown);
  refuse_without_memory(unknown ? 0 : std::size_t(size));
  return std::unique_ptr<CheckpointReader>(
      function<CheckpointReader*(const char*)>("breccia_read_checkpoint")(file.c_str()));
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
