// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "breccia/atomic_file.hpp"

namespace breccia {

/// A folder within another that is gone at the end, whatever happens. `name`: what its own begins with.
class TemporaryFolder {
 public:
  TemporaryFolder(const std::filesystem::path& within, const std::string& name) {
    std::string full = (within / (name + "-XXXXXX")).string();
    if (!mkdtemp(full.data())) throw CannotWrite(within, errno);
    path_ = full;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace breccia
