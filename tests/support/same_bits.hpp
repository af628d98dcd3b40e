// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

#include "breccia/strided.hpp"

namespace breccia {

/// Whether two arrays are equal to the last bit; those of `==` miss the sign of a zero.
template <class A, class B>
bool same_bits(const A& a, const B& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::memcmp(&a[k], &b[k], sizeof a[k]) != 0) return false;
  return true;
}

}  // namespace breccia
