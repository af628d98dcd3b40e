// SPDX-License-Identifier: BSD-3-Clause
/// A file that appears under its final name only when it is whole: the one way in which Breccia and its plugins write.
/// A library that writes files itself (VTK) writes to memory, and `write_file` takes the bytes to the disk: then a full
/// disk ends in a message with the system's reason, whatever the library makes of it.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "breccia/error.hpp"

namespace breccia {

/// Not the fault of what was to be written: no other file will fare better.
class BRECCIA_API CannotWrite : public UserError {
 public:
  CannotWrite(const std::filesystem::path& file, int reason)
      : UserError("cannot write " + file.string() + ": " + std::strerror(reason)), reason_(reason) {}
  int reason() const { return reason_; }  ///< the system's, `errno`

 private:
  int reason_;
};

/// Writes to `<name>.partial` beside the final name; `commit` writes out, closes, checks and renames. Without a commit
/// the partial file stays only if `keep_partial` (a growing file whose rows are of use after a crash). CannotWrite
/// names the file and the system's reason. A killed process leaves the file that had the name before; a machine that
/// loses power may lose what the system had not yet taken to the disk.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, bool keep_partial = false)
      : path_(std::move(path)), partial_(path_.string() + ".partial"), keep_partial_(keep_partial) {
    do file_ = open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    while (file_ < 0 && errno == EINTR);
    if (file_ < 0) fail(errno);
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile() {
    if (done_) return;
    if (keep_partial_) (void)put(waiting_);
    if (file_ >= 0) close(file_);
    if (!keep_partial_) unlink(partial_.c_str());
  }

  void write(std::string_view text) {
    if (waiting_.size() + text.size() < at_once) {
      waiting_ += text;
      return;
    }
    flush();
    if (const int reason = put(text)) fail(reason);
  }

  /// Hands all to the system: other processes see it in the partial file.
  void flush() {
    if (const int reason = put(waiting_)) fail(reason);
    waiting_.clear();
  }

  void commit() {
    flush();
    // Some network file systems tell of a full disk or a quota only here.
    const int closed = close(file_);
    file_ = -1;
    if (closed != 0 && errno != EINTR) fail(errno);
    if (std::rename(partial_.c_str(), path_.c_str()) != 0) fail(errno);
    done_ = true;
  }

 private:
  static constexpr std::size_t at_once = std::size_t(1) << 16;

  /// The system's reason when not all of it could be written, else 0.
  int put(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t n = ::write(file_, text.data(), text.size());
      if (n > 0) text.remove_prefix(std::size_t(n));
      else if (n == 0) return ENOSPC;
      else if (errno != EINTR) return errno;
    }
    return 0;
  }
  [[noreturn]] void fail(int reason) const { throw CannotWrite(path_, reason); }

  std::filesystem::path path_, partial_;
  std::string waiting_;
  int file_ = -1;
  bool keep_partial_, done_ = false;
};

/// The whole of a file in one go, text or not.
inline void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace breccia
