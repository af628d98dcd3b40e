// SPDX-License-Identifier: BSD-3-Clause
/// A file that appears under its final name only when it is whole.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace breccia {

/// Writes to `<name>.partial` beside the final name; `commit` flushes, checks and renames. Without a commit the partial
/// file stays only if `keep_partial` (a growing file whose rows are of use after a crash). UserError names the file and
/// the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, bool keep_partial = false);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(std::string_view text);
  void flush();
  void commit();

 private:
  [[noreturn]] void fail() const;
  std::filesystem::path path_, partial_;
  std::ofstream stream_;
  bool keep_partial_, done_ = false;
};

/// The whole of a file in one go.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace breccia
