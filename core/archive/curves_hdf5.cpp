// SPDX-License-Identifier: BSD-3-Clause
// Part of the library that calls HDF5, see checkpoint_hdf5.cpp.
#include <algorithm>

#include "archive/hdf5_tools.hpp"
#include "breccia/services.hpp"

namespace breccia {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw UserError("the curves cannot be written as HDF5: " + what + ": is there memory enough?");
}

void add_text(hid_t to, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type, text.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle attribute(H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, type, text.c_str()) < 0) refuse(name);
}

void add_curve(hid_t file, const Column& column, std::span<const double> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose), how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(how, false);  // the same curves, the same bytes
  if (size > 64) {
    const hsize_t chunk = std::min<hsize_t>(size, hsize_t(1) << 16);
    H5Pset_chunk(how, 1, &chunk);
    H5Pset_shuffle(how);
    H5Pset_deflate(how, 4);
  }
  const Handle set(H5Dcreate2(file, column.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT),
                   H5Dclose);
  if (set < 0 || (size > 0 && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0))
    refuse(column.name);
  add_text(set, "unit", column.unit);
  add_text(set, "description", column.doc);
}

}  // namespace
}  // namespace breccia

extern "C" __attribute__((visibility("default"))) void breccia_curves_hdf5(const breccia::Curves& curves,
                                                                           std::string& image) {
  using namespace breccia;
  hdf5_is_silent();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, std::size_t(1) << 20, false);
  const Handle file(H5Fcreate(name_of_hdf5_in_memory().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (file < 0) refuse("no file in memory");
  add_text(file, "format", "breccia curves 1");
  for (const Column& column : curves.columns()) add_curve(file, column, curves.column(column.name));
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) refuse("the end");
  const std::vector<char> bytes = image_of(file);
  if (bytes.empty()) refuse("the end");
  image.assign(bytes.begin(), bytes.end());
}
