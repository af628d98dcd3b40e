// SPDX-License-Identifier: BSD-3-Clause
/// What acts on particles besides other particles: the protocol's forces and torques and those of walls, in one sum.
#pragma once

#include <vector>

#include "engine/archive_by_id.hpp"
#include "model/state.hpp"

namespace breccia {

/// Most particles are far from walls and applied forces: only groups of rows that may have a load have any memory. Of a
/// specimen in parts: of own particles.
class ExternalLoads {
 public:
  static constexpr std::size_t group = 32;
  struct Load {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // [N], [N m]
  };

  /// What is applied alone, and room for those of the walls that are near.
  void reset(const State& s) {
    const Particles& p = s.particles;
    clear(p);
    for (std::size_t a = p.first_own(); a < p.end_own(); ++a) {
      const Load applied = of(p, a);
      if (!applied.force.isZero(0) || !applied.torque.isZero(0)) row(a) = applied;
    }
    for (const WallTouch& t : s.wall_touches) row(t.particle);
  }
  /// Of a wall that is near; or by how much what the protocol applies was changed [N], [N m].
  void add(Index particle, const Vec3& force, const Vec3& torque) {
    Load& load = row(particle);
    load.force += force;
    load.torque += torque;
  }
  /// Before the walls' forces of a step, for each particle that is near one.
  void restart(Index particle, const Particles& p) { row(particle) = of(p, particle); }
  /// Null when there is none.
  const Load* of(std::size_t particle) const {
    const std::size_t at = particle + shift_;
    const Index begin = begin_[at / group];
    return begin == none ? nullptr : &rows_[begin + at % group];
  }
  /// The first particle after `particle` of which `of` may say something else.
  std::size_t end_of_group(std::size_t particle) const { return ((particle + shift_) / group + 1) * group - shift_; }
  /// Groups begin at the same particles in a part and in the whole.
  void shift_to(const Particles& p) { shift_ = p.shift(); }

  /// As they stand: the protocol's changes have left their rounding in them.
  void archive(SpecimenArchive& archive, const Particles& p) {
    std::vector<Vec3> force(p.size(), Vec3::Zero()), torque = force;
    std::vector<std::uint8_t> groups((p.end_own() - p.first_own() + group - 1) / group);
    const auto group_of = [&](std::size_t a) -> std::uint8_t& { return groups.at((a - p.first_own()) / group); };
    if (!archive.reading())
      for (std::size_t a = p.first_own(); a < p.end_own(); ++a)
        if (const Load* const load = of(a)) {
          group_of(a) = 1;
          force[a] = load->force;
          torque[a] = load->torque;
        }
    archive.by_id("force", Strided<Vec3>(force));
    archive.by_id("torque", Strided<Vec3>(torque));
    archive.own_records("groups", groups);
    if (!archive.reading()) return;
    clear(p);
    for (std::size_t a = p.first_own(); a < p.end_own(); ++a)
      if (group_of(a)) row(a) = {force[a], torque[a]};
  }
  void clear(const Particles& p) {
    rows_.clear();
    shift_ = p.shift();
    begin_.assign((p.end_own() + shift_ + group - 1) / group, none);
  }

 private:
  static constexpr Index none = 0xffffffffu;
  static Load of(const Particles& p, std::size_t particle) {
    Load load;
    if (!p.applied_force.empty()) load.force = p.applied_force[particle];
    if (!p.applied_torque.empty()) load.torque = p.applied_torque[particle];
    return load;
  }
  Load& row(std::size_t particle) {
    particle += shift_;
    Index& begin = begin_[particle / group];
    if (begin == none) {
      begin = Index(rows_.size());
      rows_.resize(rows_.size() + group);
    }
    return rows_[begin + particle % group];
  }

  std::size_t shift_ = 0;     ///< of the rows here against those of the whole
  std::vector<Index> begin_;  ///< of each group of particles, its rows; or none
  std::vector<Load> rows_;
};

}  // namespace breccia
