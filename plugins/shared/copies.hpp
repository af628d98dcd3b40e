// SPDX-License-Identifier: BSD-3-Clause
/// Copies of particles side by side: each is the original moved by whole numbers of edges.
#pragma once

#include <array>

#include "breccia/packing.hpp"

namespace breccia {

/// Which copies: so many along x, y, z, from these numbers on; the original is number 0.
struct CopyNumbers {
  std::array<long, 3> first{}, count{1, 1, 1};
};

/// Calls f(shift) for each [m], those along z first.
template <class F>
void for_each_copy(const CopyNumbers& numbers, const Vec3& edge, F&& f) {
  const auto& [first, count] = numbers;
  for (long a = first[0]; a < first[0] + count[0]; ++a)
    for (long b = first[1]; b < first[1] + count[1]; ++b)
      for (long c = first[2]; c < first[2] + count[2]; ++c)
        f(Vec3(double(a) * edge.x(), double(b) * edge.y(), double(c) * edge.z()));
}

/// Adds the particles of `one`, moved, for which `keep(centre)` is true, with what is known of them.
template <class Keep>
void append_moved(const PackedParticles& one, const Vec3& shift, Keep&& keep, PackedParticles& all) {
  for (std::size_t k = 0; k < one.radius.size(); ++k) {
    const Vec3 x = one.position[k] + shift;
    if (!keep(x)) continue;
    all.position.push_back(x);
    all.radius.push_back(one.radius[k]);
    for (std::size_t c = 0; c < one.columns.size(); ++c) all.columns[c].second.push_back(one.columns[c].second[k]);
  }
}

}  // namespace breccia
