// SPDX-License-Identifier: BSD-3-Clause
/// The beginning of a checkpoint: what it is, and what its bytes add up to.
///
/// The digest is that of the digests of blocks, so that several processes can have a part in it, however many:
/// `tail -c +513 FILE | split -b 1M --filter=sha256sum | cut -c-64 | tr -d '\n' | sha256sum`
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>

#include "breccia/atomic_file.hpp"
#include "hash/sha256.hpp"

namespace breccia::checkpoint {

constexpr std::size_t header_size = 512;  // where HDF5 looks for its beginning next, after the very start
constexpr const char* any_mark = "breccia checkpoint ";
constexpr const char* mark = "breccia checkpoint 2";
constexpr std::size_t block = std::size_t(1) << 20;
constexpr std::size_t digest_size = 64;  // of a block, in hexadecimal digits

/// `digests`: of the blocks behind the header, one after the other.
inline std::string header_of(const std::string& digests) {
  std::string text = std::string(mark) + "\nsha256 of blocks " + sha256(digests) + "\n";
  text.resize(header_size, '\n');
  return text;
}

inline std::size_t blocks_of(std::size_t bytes) { return (bytes + block - 1) / block; }

inline std::string digests_of(std::string_view bytes) {
  std::string digests;
  for (std::size_t at = 0; at < bytes.size(); at += block) digests += sha256(bytes.substr(at, block));
  return digests;
}

/// The file that has this name is on the disk under it, or the folder with what it lists.
inline void reach_the_disk(const std::filesystem::path& place, int flags) {
  const int opened = ::open(place.c_str(), flags | O_CLOEXEC);
  if (opened < 0) return;
  const int failed = fsync(opened) != 0 ? errno : 0;
  close(opened);
  if (failed && failed != EINVAL) throw CannotWrite(place, failed);
}

/// A whole file gets its name. Else it is gone: CannotWrite.
inline void give_name(const std::filesystem::path& arriving, const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  try {
    reach_the_disk(arriving, O_RDONLY);
    fs::rename(arriving, name);
    reach_the_disk(name.parent_path(), O_RDONLY | O_DIRECTORY);
  } catch (const fs::filesystem_error& e) {
    std::error_code gone;
    fs::remove(arriving, gone);
    throw CannotWrite(name, e.code().value());
  } catch (...) {
    std::error_code gone;
    fs::remove(arriving, gone);
    throw;
  }
}

}  // namespace breccia::checkpoint
