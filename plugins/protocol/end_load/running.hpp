// SPDX-License-Identifier: BSD-3-Clause
/// What changes while the test runs, and how far from rest a specimen is.
#pragma once

#include "breccia/block_sum.hpp"
#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/smooth_ramp.hpp"

namespace breccia::end_load {

enum class Ending { none, rest, duration, max_displacement, max_time, first_break };

struct Running {
  SmoothRamp ramp;
  double factor = 0, last_time = 0, full_at = 0, displacement = 0, unrest = 1, factor_at_break = -1;
  std::size_t broken_before = 0;
  std::uint32_t since_look = 0;
  Ending ended = Ending::none;
  bool begun = false, marked = false;
  std::vector<Vec3> rotation;  ///< of the groups, supports first [rad]

  void archive(Archive& archive) {
    archive("ramp", ramp);
    for (auto& [name, value] : {std::pair<const char*, double*>("factor", &factor),
                                {"last_time", &last_time},
                                {"full_at", &full_at},
                                {"displacement", &displacement},
                                {"unrest", &unrest},
                                {"factor_at_break", &factor_at_break}})
      archive(name, *value);
    archive("broken_before", broken_before);
    archive("since_look", since_look);
    archive("ended", ended);
    archive("begun", begun);
    archive("marked", marked);
    archive("rotation", rotation);
  }
};

/// Sum of the resultants on what is free, torques over the radii [N].
inline double free_resultants(const SimulationView& view) {
  const ParticlesView& p = view.particles;
  BlockSum<double> sum(view);
  for (const std::size_t k : view.own_particles()) {
    Vec3 force = p.force[k], torque = p.torque[k];
    for (int c = 0; c < 3; ++c) {
      if (p.held[k] >> c & 1) force[c] = 0;
      if (p.held[k] >> (c + 3) & 1) torque[c] = 0;
    }
    sum.add(k, force.norm() + torque.norm() / p.radius[k]);
  }
  return view.sum(sum.exact());
}

/// In all [J].
inline double kinetic_energy(const SimulationView& view) {
  const ParticlesView& p = view.particles;
  BlockSum<double> sum(view);
  for (const std::size_t k : view.own_particles())
    sum.add(k, 0.5 * p.mass[k] *
                   (p.velocity[k].squaredNorm() + view.gyration(p.radius[k]) * p.angular_velocity[k].squaredNorm()));
  return view.sum(sum.exact());
}

}  // namespace breccia::end_load
