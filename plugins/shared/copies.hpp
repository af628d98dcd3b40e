// SPDX-License-Identifier: BSD-3-Clause
/// Copies of particles side by side: each is the original moved by whole numbers of edges.
#pragma once

#include <array>

#include "breccia/packing.hpp"

namespace breccia {

/// Which copies: so many along x, y, z, from these numbers on; the original is number 0.
struct CopyNumbers {
  std::array<long, 3> first{}, count{1, 1, 1};

  std::size_t all() const { return std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]); }
  /// Numbers along x, y, z of the k-th of all, those along z first.
  std::array<long, 3> of(std::size_t k) const {
    const std::size_t y = std::size_t(count[1]), z = std::size_t(count[2]);
    return {first[0] + long(k / z / y), first[1] + long(k / z % y), first[2] + long(k % z)};
  }
};

/// By how much a copy is moved [m].
inline Vec3 shift_of(const std::array<long, 3>& copy, const Vec3& edge) {
  return Vec3(double(copy[0]) * edge.x(), double(copy[1]) * edge.y(), double(copy[2]) * edge.z());
}

/// Adds a particle of `one`, moved, with what is known of it.
inline void append_moved(const PackedParticles& one, std::size_t k, const Vec3& shift, PackedParticles& all) {
  all.position.push_back(one.position[k] + shift);
  all.radius.push_back(one.radius[k]);
  for (std::size_t c = 0; c < one.columns.size(); ++c) all.columns[c].second.push_back(one.columns[c].second[k]);
}

}  // namespace breccia
