// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace breccia {

/// One try to have a file to oneself; it is made for that and removed at the end. The lock is the system's, so that it
/// ends with the process whatever ends that.
class FileLock {
 public:
  enum class State {
    held,
    with_another,  ///< has it
    without_locks  ///< of the file system: nobody is kept out
  };
  /// system_error when the file cannot be made.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

  State state() const { return state_; }
  /// Into the file, for those who find it closed; a full disk leaves it empty.
  void say(const std::string& who) const;

 private:
  std::filesystem::path name_;
  int file_ = -1;
  State state_ = State::held;
};

}  // namespace breccia
