// SPDX-License-Identifier: BSD-3-Clause
/// Lists of a specimen in a checkpoint: particles in the order of the packing, pairs and bonds in that of the whole,
/// whatever the engine's order is. A whole specimen is written; a whole one is read, or this rank's part of it.
#pragma once

#include <vector>

#include "breccia/archive.hpp"
#include "engine/parts.hpp"
#include "engine/rows_of_state.hpp"
#include "model/state.hpp"

namespace breccia {

inline std::vector<Index> inverse_of(const std::vector<Index>& id) {
  std::vector<Index> row(id.size());
  for (Index k = 0; k < id.size(); ++k) row[id[k]] = k;
  return row;
}

class SpecimenArchive {
 public:
  /// `particles` outlive this. `parts`: of a specimen in parts, which is read by all ranks together, each from an
  /// archive of its own; else null.
  SpecimenArchive(Archive& archive, const Particles& particles, const Parts* parts)
      : archive_(archive),
        p_(particles),
        parts_(parts),
        id_(parts ? parts->gathered_rows(particles.id, particles, true) : particles.id),
        row_(inverse_of(id_)) {
    BRECCIA_ASSERT(!parts || archive.reading());
  }
  Archive& plain() { return archive_; }
  bool reading() const { return archive_.reading(); }
  const Parts* parts() const { return parts_; }
  std::size_t size() const { return id_.size(); }  ///< particles of the whole

  /// A value for each particle.
  template <class T>
  void by_id(std::string_view name, Strided<T> values) {
    std::vector<T> ordered(id_.size());
    if (!reading())
      for (std::size_t k = 0; k < values.size(); ++k) ordered[p_.id[k]] = values[k];
    archive_(name, Strided<T>(ordered));
    if (reading())
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = ordered[p_.id[k]];
  }
  /// One that is empty, or has a value for each particle.
  template <class T>
  void by_id(std::string_view name, std::vector<T>& values) {
    std::uint8_t there = !values.empty();
    archive_(std::string(name) + "_is_there", there);
    if (reading()) values.assign(there ? p_.size() : 0, T());
    if (there) by_id(name, Strided<T>(values));
  }

  std::vector<Index> kept_pairs, kept_bonds;  ///< of a part: which of the whole are read
  /// A value for each pair or bond.
  template <class T>
  void list(std::string_view name, std::vector<T>& values, const std::vector<Index>& kept) {
    archive_(name, values);
    if (parts_) pick(values, kept);
  }
  /// Numbers of particles: here rows of the whole, in the file the packing's.
  void rows(std::string_view name, std::vector<Index>& numbers) {
    std::vector<Index> ids;
    if (!reading())
      for (const Index k : numbers) ids.push_back(id_[k]);
    archive_(name, ids);
    if (!reading()) return;
    numbers.clear();
    for (const Index k : ids) numbers.push_back(row_.at(k));
  }
  /// Near walls: particle, wall and what has come of their friction; of a part those of own particles.
  void touches(std::string_view name, std::vector<WallTouch>& of) {
    archive_.records(name, of, std::pair("wall", &WallTouch::wall), std::pair("spring", &WallTouch::spring),
                     std::pair("force", &WallTouch::force), std::pair("overlap", &WallTouch::overlap));
    std::vector<Index> particles;
    for (const WallTouch& t : of) particles.push_back(t.particle);
    rows(std::string(name) + "_particles", particles);
    for (std::size_t k = 0; k < of.size(); ++k) of[k].particle = particles.at(k);
    if (!parts_) return;
    std::erase_if(
        of, [&](const WallTouch& t) { return t.particle < parts_->first_row() || t.particle >= parts_->end_row(); });
    for (WallTouch& t : of) t.particle = Parts::here(p_, t.particle);
  }

 private:
  Archive& archive_;
  const Particles& p_;
  const Parts* parts_;
  const std::vector<Index> id_, row_;  ///< of each row of the whole; and the inverse
};

}  // namespace breccia
