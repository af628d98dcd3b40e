// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "results/results_folder.hpp"

namespace breccia {

namespace {

/// "process 123 on host", as the one who has the lock left it.
std::string holder(const std::filesystem::path& lock_file) {
  std::ifstream in(lock_file);
  std::string pid, host;
  if (!(in >> pid >> host)) return "another process";
  return "process " + pid + " on " + host;
}

/// Whether what is open still stands under that name.
bool is_file(int opened, const std::filesystem::path& name) {
  struct stat mine, there;
  return fstat(opened, &mine) == 0 && stat(name.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
         mine.st_dev == there.st_dev;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, Host& host) : name_(folder / ".breccia.lock") {
  for (;;) {
    file_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) throw UserError("cannot write to the folder " + folder.string() + ": " + std::strerror(errno));
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const int why = errno;
      if (why == EINTR) {
        close(file_);
        continue;
      }
      if (why != EWOULDBLOCK) {
        host.warn("the file system of " + folder.string() +
                  " has no locks: make sure that no other run writes into this folder");
        break;
      }
      close(file_);
      throw FolderInUse("the folder " + folder.string() + " is in use by another run (" + holder(name_) +
                        "); nothing was changed. Wait for it, or choose another with --output");
    }
    // The one who had it may have removed the file while this process was waiting for its turn.
    if (is_file(file_, name_)) break;
    close(file_);
  }
  char machine[256] = "an unnamed host";
  (void)gethostname(machine, sizeof machine - 1);
  const std::string who = std::to_string(getpid()) + " " + machine + "\n";
  if (ftruncate(file_, 0) != 0 || pwrite(file_, who.data(), who.size(), 0) < 0)
    return;  // a full disk: the lock holds without a name
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  if (is_file(file_, name_)) unlink(name_.c_str());  // while it is still closed to others; not another's
  close(file_);
}

}  // namespace breccia
