// SPDX-License-Identifier: BSD-3-Clause
#include "results/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace breccia {

namespace {

/// Whether what is open still stands under that name.
bool is_file(int opened, const std::filesystem::path& name) {
  struct stat mine, there;
  return fstat(opened, &mine) == 0 && stat(name.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
         mine.st_dev == there.st_dev;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file) : name_(file) {
  for (;;) {
    file_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) throw std::system_error(errno, std::generic_category());
    if (flock(file_, LOCK_EX | LOCK_NB) == 0) {
      if (is_file(file_, name_)) return;
      // Else the one who had it has removed the file after it was opened here.
    } else if (errno == EWOULDBLOCK) {
      close(std::exchange(file_, -1));
      state_ = State::with_another;
      return;
    } else if (errno != EINTR) {
      state_ = State::without_locks;
      return;
    }
    close(file_);
  }
}

FileLock::FileLock(FileLock&& other) noexcept
    : name_(std::move(other.name_)), file_(std::exchange(other.file_, -1)), state_(other.state_) {}

void FileLock::say(const std::string& who) const {
  if (file_ < 0 || ftruncate(file_, 0) != 0 || pwrite(file_, who.data(), who.size(), 0) < 0) return;
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  if (is_file(file_, name_)) unlink(name_.c_str());  // while it is still closed to others; not another's
  close(file_);
}

}  // namespace breccia
