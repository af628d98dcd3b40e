// SPDX-License-Identifier: BSD-3-Clause
/// What acts on particles besides other particles: the protocol's forces and torques and those of walls, in one sum.
#pragma once

#include <vector>

#include "engine/archive_by_id.hpp"
#include "model/state.hpp"

namespace breccia {

/// Most particles are far from walls and applied forces: only groups of rows that may have a load have any memory.
class ExternalLoads {
 public:
  static constexpr std::size_t group = 32;
  struct Load {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // [N], [N m]
  };

  /// What is applied alone, and room for those of the walls that are near.
  void reset(const State& s) {
    const Particles& p = s.particles;
    rows_.clear();
    begin_.assign((p.size() + group - 1) / group, none);
    for (std::size_t a = 0; a < p.size(); ++a) {
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
  /// Of the particles of the group that `particle` is in, from its first on; null when there are none.
  const Load* of_group(Index particle) const {
    const Index begin = begin_[particle / group];
    return begin == none ? nullptr : &rows_[begin];
  }

  /// As they stand: the protocol's changes have left their rounding in them.
  void archive(Archive& archive, const std::vector<Index>& id) {
    std::vector<Vec3> force(id.size(), Vec3::Zero()), torque = force;
    std::vector<std::uint8_t> groups(begin_.size());
    if (!archive.reading())
      for (std::size_t a = 0; a < id.size(); ++a)
        if (const Load* const load = of_group(Index(a))) {
          groups[a / group] = 1;
          force[a] = load[a % group].force;
          torque[a] = load[a % group].torque;
        }
    archive_by_id(archive, "force", Strided<Vec3>(force), id);
    archive_by_id(archive, "torque", Strided<Vec3>(torque), id);
    archive("groups", groups);
    if (!archive.reading()) return;
    rows_.clear();
    begin_.assign(groups.size(), none);
    for (std::size_t a = 0; a < id.size(); ++a)
      if (groups.at(a / group)) row(a) = {force[a], torque[a]};
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
    Index& begin = begin_[particle / group];
    if (begin == none) {
      begin = Index(rows_.size());
      rows_.resize(rows_.size() + group);
    }
    return rows_[begin + particle % group];
  }

  std::vector<Index> begin_;  ///< of each group of particles, its rows; or none
  std::vector<Load> rows_;
};

}  // namespace breccia
