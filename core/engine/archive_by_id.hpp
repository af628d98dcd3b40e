// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of particles in a checkpoint stand in the order of the packing, whatever the engine's order is.
#pragma once

#include <vector>

#include "breccia/archive.hpp"
#include "model/state.hpp"

namespace breccia {

/// `id[k]`: where in the file the value of row k stands; a permutation.
template <class T>
void archive_by_id(Archive& archive, std::string_view name, Strided<T> values, const std::vector<Index>& id) {
  std::vector<T> ordered(values.size());
  if (!archive.reading())
    for (std::size_t k = 0; k < values.size(); ++k) ordered[id[k]] = values[k];
  archive(name, Strided<T>(ordered));
  if (archive.reading())
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = ordered[id[k]];
}

/// One that is empty, or has a value for each particle.
template <class T>
void archive_by_id(Archive& archive, std::string_view name, std::vector<T>& values, const std::vector<Index>& id) {
  std::uint8_t there = !values.empty();
  archive(std::string(name) + "_is_there", there);
  if (archive.reading()) values.assign(there ? id.size() : 0, T());
  if (there) archive_by_id(archive, name, Strided<T>(values), id);
}

/// Numbers of particles: in the file those of the packing. `row`: the inverse of `id`.
inline void archive_particles(Archive& archive, std::string_view name, Strided<Index> particles,
                              const std::vector<Index>& id, const std::vector<Index>& row) {
  std::vector<Index> numbers(particles.size());
  if (!archive.reading())
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = id[particles[k]];
  archive(name, Strided<Index>(numbers));
  if (archive.reading())
    for (std::size_t k = 0; k < numbers.size(); ++k) particles[k] = row.at(numbers[k]);
}

inline std::vector<Index> inverse_of(const std::vector<Index>& id) {
  std::vector<Index> row(id.size());
  for (Index k = 0; k < id.size(); ++k) row[id[k]] = k;
  return row;
}

/// Near walls: particle, wall and what has come of their friction.
inline void archive_touches(Archive& archive, std::string_view name, std::vector<WallTouch>& touches,
                            const std::vector<Index>& id, const std::vector<Index>& row) {
  archive.records(name, touches, std::pair("wall", &WallTouch::wall), std::pair("spring", &WallTouch::spring),
                  std::pair("force", &WallTouch::force), std::pair("overlap", &WallTouch::overlap));
  const Strided<Index> particles(touches.empty() ? nullptr : &touches.front().particle, touches.size(),
                                 sizeof(WallTouch));
  archive_particles(archive, std::string(name) + "_particles", particles, id, row);
}

}  // namespace breccia
