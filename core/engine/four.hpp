// SPDX-License-Identifier: BSD-3-Clause
/// Four numbers at a time, side by side in a record, and the turn from four records to four arrays and back: what takes
/// the place of a gather. The compiler makes of it what the machine has; the bits are those of scalars.
#pragma once

#include "breccia/contact.hpp"

namespace breccia {

typedef double Four __attribute__((vector_size(32), aligned(32), may_alias));

BRECCIA_KERNEL Four& four(double* at) { return *reinterpret_cast<Four*>(at); }
BRECCIA_KERNEL const Four& four(const double* at) { return *reinterpret_cast<const Four*>(at); }
/// A vector and the number that stands behind it in its record.
BRECCIA_KERNEL Four& four(Vec3& at) { return four(at.data()); }
BRECCIA_KERNEL const Four& four(const Vec3& at) { return four(at.data()); }

/// The matrix whose rows are a, b, c, d becomes its transpose.
BRECCIA_KERNEL void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7),
             cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

}  // namespace breccia
