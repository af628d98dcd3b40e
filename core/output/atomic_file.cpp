// SPDX-License-Identifier: BSD-3-Clause
#include "output/atomic_file.hpp"

#include <cerrno>
#include <cstring>

#include "breccia/error.hpp"

namespace breccia {

AtomicFile::AtomicFile(std::filesystem::path path, bool keep_partial)
    : path_(std::move(path)), partial_(path_.string() + ".partial"), keep_partial_(keep_partial) {
  errno = 0;
  stream_.open(partial_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail();
}

AtomicFile::~AtomicFile() {
  if (done_ || keep_partial_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void AtomicFile::fail() const {
  const char* why = errno ? std::strerror(errno) : "write error";
  throw UserError("cannot write " + path_.string() + ": " + why);
}

void AtomicFile::write(std::string_view text) {
  errno = 0;
  if (!stream_.write(text.data(), std::streamsize(text.size()))) fail();
}

void AtomicFile::flush() {
  errno = 0;
  if (!stream_.flush()) fail();
}

void AtomicFile::commit() {
  flush();
  errno = 0;
  stream_.close();
  if (stream_.fail()) fail();
  std::error_code error;
  std::filesystem::rename(partial_, path_, error);
  if (error) throw UserError("cannot write " + path_.string() + ": " + error.message());
  done_ = true;
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace breccia
