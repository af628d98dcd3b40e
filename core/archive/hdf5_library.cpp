// SPDX-License-Identifier: BSD-3-Clause
#include "archive/hdf5_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <boost/dll/runtime_symbol_info.hpp>
#include <filesystem>
#include <new>

#include "breccia/error.hpp"

namespace breccia {
namespace fs = std::filesystem;

namespace {

/// Loaded once, and kept.
void* library() {
  static void* const loaded = [] {
    std::error_code unknown;
    const fs::path program = boost::dll::program_location(unknown).parent_path(),
                   file = (program / "../lib/breccia-core/breccia_checkpoint_hdf5.so").lexically_normal();
    void* const opened = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!opened)
      throw UserError(
          fmt::format("checkpoints and curves in HDF5 need {}, which cannot be loaded: {}", file.string(), dlerror()));
    return opened;
  }();
  return loaded;
}

}  // namespace

void* hdf5_symbol(const char* name) {
  void* const found = dlsym(library(), name);
  BRECCIA_ASSERT(found);
  return found;
}

/// It holds a file twice while that grows, in steps of up to 4 MB, and gives it out once more; the rest is for the
/// library itself.
void hdf5_needs_memory(std::size_t bytes) {
  const std::size_t size = 4 * bytes + (std::size_t(24) << 20);
  void* const all = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  munmap(all, size);
}

}  // namespace breccia
