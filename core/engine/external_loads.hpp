// SPDX-License-Identifier: BSD-3-Clause
/// What acts on particles besides other particles: the protocol's forces and torques and those of walls, in one sum.
#pragma once

#include <vector>

#include "engine/archive_by_id.hpp"
#include "model/state.hpp"

namespace breccia {

/// A row for each particle. Most are far from walls and applied forces: a group of rows that are all zero is marked so,
/// and neither read nor added.
class ExternalLoads {
 public:
  static constexpr std::size_t group = 32;

  /// What is applied alone, and room for those of the walls that are near.
  void reset(const State& s) {
    force_ = s.particles.applied_force;
    torque_ = s.particles.applied_torque;
    torque_.resize(force_.size(), Vec3::Zero());
    any_.assign((force_.size() + group - 1) / group, 0);
    for (std::size_t a = 0; a < force_.size(); ++a)
      if (!force_[a].isZero(0) || !torque_[a].isZero(0)) any_[a / group] = 1;
    for (const WallTouch& t : s.wall_touches) any_[t.particle / group] = 1;
  }
  /// The protocol's force on a particle was changed by so much [N].
  void change(Index particle, const Vec3& force) {
    force_[particle] += force;
    any_[particle / group] = 1;
  }
  /// The same of its torque [N m].
  void turn(Index particle, const Vec3& torque) {
    torque_[particle] += torque;
    any_[particle / group] = 1;
  }
  /// Before the walls' forces of a step, for each particle that is near one.
  void restart(Index particle, const Particles& p) {
    force_[particle] = p.applied_force[particle];
    torque_[particle] = p.applied_torque.empty() ? Vec3(Vec3::Zero()) : p.applied_torque[particle];
  }
  /// Of a wall that is near, since `reset`.
  void add(Index particle, const Vec3& force, const Vec3& torque) {
    force_[particle] += force;
    torque_[particle] += torque;
  }
  bool any(Index particle) const { return any_[particle / group]; }       ///< in the particle's group
  const Vec3& force(Index particle) const { return force_[particle]; }    // [N]
  const Vec3& torque(Index particle) const { return torque_[particle]; }  // [N m]

  /// As they stand: the protocol's changes have left their rounding in them.
  void archive(Archive& archive, const std::vector<Index>& id) {
    archive_by_id(archive, "force", Strided<Vec3>(force_), id);
    archive_by_id(archive, "torque", Strided<Vec3>(torque_), id);
    archive("groups", any_);
  }

 private:
  std::vector<Vec3> force_, torque_;
  std::vector<std::uint8_t> any_;
};

}  // namespace breccia
