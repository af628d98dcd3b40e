// SPDX-License-Identifier: BSD-3-Clause
/// What those have in common who call HDF5. Only for what is built into `breccia_checkpoint_hdf5.so`,
/// and for the link to other ranks, whose HDF5 is another library.
#pragma once

#include <hdf5.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "breccia/archive.hpp"

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

/// How numbers stand here, in the file, and how many bytes each has.
struct Hdf5Type {
  hid_t memory, file;
  std::size_t size;
};
inline Hdf5Type hdf5_type_of(archived::Element e) {
  using archived::Element;
  switch (e) {
    case Element::f64:
      return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 8};
    case Element::i32:
      return {H5T_NATIVE_INT32, H5T_STD_I32LE, 4};
    case Element::i64:
      return {H5T_NATIVE_INT64, H5T_STD_I64LE, 8};
    case Element::u32:
      return {H5T_NATIVE_UINT32, H5T_STD_U32LE, 4};
    case Element::u64:
      return {H5T_NATIVE_UINT64, H5T_STD_U64LE, 8};
    case Element::u8:
    case Element::text:
      break;
  }
  return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1};
}

/// A new list, all of it in one piece, as all ranks can write it at once; below zero when it cannot be made.
inline hid_t made_list(hid_t file, const std::string& path, archived::Element element, std::size_t rows,
                       std::size_t columns) {
  const hsize_t size[2] = {rows, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_alloc_time(how, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(how, H5D_FILL_TIME_NEVER);
  H5Pset_obj_track_times(how, false);  // the same state, the same bytes
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  return H5Dcreate2(file, path.c_str(), hdf5_type_of(element).file, space, link, how, H5P_DEFAULT);
}

/// False when it cannot be made.
inline bool make_group(hid_t file, const std::string& path) {
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link, 1);
  return Handle(H5Gcreate2(file, path.c_str(), link, H5P_DEFAULT, H5P_DEFAULT), H5Gclose) >= 0;
}

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
