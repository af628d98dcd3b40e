// SPDX-License-Identifier: BSD-3-Clause
/// What those have in common who write a checkpoint.
#pragma once

#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "breccia/error.hpp"

namespace breccia {

/// Names that are taken. HDF5 would fail at a name that is there twice, and cannot say that it was only that.
class CheckpointNames {
 public:
  /// Notes what is to be made: false where that group is there. UserError where something else is.
  bool claim(const std::string& path, bool array) {
    const auto twice = [&] { return UserError("no checkpoint can be made: " + path + ": is there twice"); };
    if (arrays_.contains(path) || (array && groups_.contains(path))) throw twice();
    if (!array && groups_.contains(path)) return false;
    for (std::size_t at = path.find('/', 1); at != path.npos; at = path.find('/', at + 1)) {
      if (arrays_.contains(path.substr(0, at))) throw twice();
      groups_.insert(path.substr(0, at));
    }
    (array ? arrays_ : groups_).insert(path);
    return true;
  }

 private:
  std::set<std::string> arrays_, groups_;
};

/// Rows of so many bytes each, one behind the other; empty when they stand so already.
inline std::vector<char> packed_rows(const void* data, std::size_t rows, std::size_t row, std::size_t stride) {
  std::vector<char> packed;
  if (stride == row || rows < 2) return packed;
  packed.resize(rows * row);
  for (std::size_t k = 0; k < rows; ++k)
    std::memcpy(packed.data() + k * row, static_cast<const char*>(data) + k * stride, row);
  return packed;
}

}  // namespace breccia
