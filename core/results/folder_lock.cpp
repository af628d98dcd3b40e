// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <fstream>
#include <system_error>

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

FileLock locked(const std::filesystem::path& folder) {
  try {
    return FileLock(folder / ".breccia.lock");
  } catch (const std::system_error& e) {
    throw UserError("cannot write to the folder " + folder.string() + ": " + e.code().message());
  }
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, Host& host) : lock_(locked(folder)) {
  if (lock_.state() == FileLock::State::with_another)
    throw FolderInUse("the folder " + folder.string() + " is in use by another run (" +
                      holder(folder / ".breccia.lock") +
                      "); nothing was changed. Wait for it, or choose another with --output");
  if (lock_.state() == FileLock::State::without_locks)
    host.warn("the file system of " + folder.string() +
              " has no locks: make sure that no other run writes into this folder");
  char machine[256] = "an unnamed host";
  (void)gethostname(machine, sizeof machine - 1);
  lock_.say(std::to_string(getpid()) + " " + machine + "\n");
}

}  // namespace breccia
