// SPDX-License-Identifier: BSD-3-Clause
/// The bytes of an input, one value after the other.
#pragma once

#include <algorithm>
#include <cstring>
#include <string_view>

namespace breccia::fuzz {

/// Zeros when there are no more.
class Script {
 public:
  explicit Script(std::string_view bytes) : bytes_(bytes) {}
  bool ended() const { return bytes_.empty(); }
  std::string_view rest() const { return bytes_; }
  template <class T>
  T next() {
    T value{};
    const std::size_t n = std::min(sizeof(T), bytes_.size());
    std::memcpy(&value, bytes_.data(), n);
    bytes_.remove_prefix(n);
    return value;
  }

 private:
  std::string_view bytes_;
};

}  // namespace breccia::fuzz
