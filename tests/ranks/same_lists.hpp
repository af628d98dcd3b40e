// SPDX-License-Identifier: BSD-3-Clause
/// Whether two files of HDF5 hold the same, list by list, however they were written.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breccia::testing {

/// Shape and bytes of each list, by its name.
using Lists = std::map<std::string, std::pair<std::vector<hsize_t>, std::vector<char>>>;

inline Lists lists_of(const std::filesystem::path& file) {
  Lists all;
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  std::vector<std::string> names;
  const auto note = [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(to)->push_back(name);
    return 0;
  };
  H5Ovisit(opened, H5_INDEX_NAME, H5_ITER_INC, note, &names);
  for (const std::string& name : names) {
    const hid_t set = H5Dopen2(opened, name.c_str(), H5P_DEFAULT), type = H5Dget_type(set), space = H5Dget_space(set);
    auto& [shape, bytes] = all[name];
    shape.resize(std::size_t(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    bytes.resize(std::size_t(H5Sget_simple_extent_npoints(space)) * H5Tget_size(type));
    if (!bytes.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) bytes = {'?'};
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  }
  H5Fclose(opened);
  return all;
}

/// The names under which they are not the same; `but`: one that is the copy of a structure, whose holes hold anything.
inline std::string different_lists(const std::filesystem::path& file, const std::filesystem::path& other,
                                   const std::string& but) {
  Lists a = lists_of(file), b = lists_of(other);
  a.at(but).second.clear();
  b.at(but).second.clear();
  std::string different;
  for (const auto* both : {&a, &b})
    for (const auto& [name, list] : *both)
      if (!a.contains(name) || !b.contains(name) || a.at(name) != b.at(name)) different += name + "\n";
  return different;
}

}  // namespace breccia::testing
