// SPDX-License-Identifier: BSD-3-Clause
/// What acts on particles besides other particles: the protocol's forces and those of walls, in one sum.
#pragma once

#include <vector>

#include "model/state.hpp"

namespace breccia {

class ExternalLoads {
 public:
  /// No wall touches any particle.
  void reset(const Particles& p) {
    force_ = p.applied_force;
    torque_.assign(p.size(), Vec3::Zero());
  }
  /// The protocol's force on a particle was changed by so much [N].
  void change(Index particle, const Vec3& force) { force_[particle] += force; }
  /// Before the walls' forces of a step, for each particle that is near one.
  void restart(Index particle, const Particles& p) {
    force_[particle] = p.applied_force[particle];
    torque_[particle].setZero();
  }
  void add(Index particle, const Vec3& force, const Vec3& torque) {
    force_[particle] += force;
    torque_[particle] += torque;
  }
  const Vec3& force(Index particle) const { return force_[particle]; }    // [N]
  const Vec3& torque(Index particle) const { return torque_[particle]; }  // [N m]

 private:
  std::vector<Vec3> force_, torque_;
};

}  // namespace breccia
