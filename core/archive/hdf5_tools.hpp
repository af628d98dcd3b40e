// SPDX-License-Identifier: BSD-3-Clause
/// What those have in common who call HDF5. Only for what is built into `breccia_checkpoint_hdf5.so`.
#pragma once

#include <hdf5.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace breccia {

/// A handle of the library's, and the call that gives it back.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Before anything else of the library. Whatever it could not close, for want of memory, it would stumble over when the
/// program ends.
inline void hdf5_is_silent() {
  H5dont_atexit();  // only before its first other call
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// For the library, which takes two open files of one name for the same: a name that no file has, and no other one
/// here.
inline std::string name_of_hdf5_in_memory() {
  static std::atomic<std::uint64_t> last{0};
  return "/dev/null/breccia " + std::to_string(++last);
}

/// The bytes of a file in memory that was flushed; none when the library does not give them.
inline std::vector<char> image_of(hid_t file) {
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  std::vector<char> image(size > 0 ? std::size_t(size) : 0);
  if (size <= 0 || H5Fget_file_image(file, image.data(), image.size()) != size) image.clear();
  return image;
}

}  // namespace breccia
