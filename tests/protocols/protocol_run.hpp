// SPDX-License-Identifier: BSD-3-Clause
/// A protocol from its library on a small specimen, stepped as a run would step it.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "check/protocol_rig.hpp"
#include "support/support.hpp"

namespace breccia::testing {

inline const Registry& registry() {
  static const Registry all;
  return all;
}

inline std::unique_ptr<Protocol> make_protocol(const std::string& name, Json config) {
  for (const ParamSpec& p : registry().documentation("protocol", name).root.members)
    if (!config.contains(p.name) && !p.fallback.is_null()) config[p.name] = p.fallback;
  return registry().create<Protocol>({name, config});
}

class ProtocolRun {
 public:
  ProtocolRun(const PackedParticles& packing, const Json& law, const std::string& law_name, double tolerance,
              const std::string& protocol, const Json& config, int dimension = 3, int threads = 1, double damping = 0.5)
      : rig_(registry(), packing, PluginStack{{{law_name, law}}}, make_protocol(protocol, config),
             {dimension, 1.0, tolerance, threads, {20, 0}, damping}) {}

  /// To the protocol's end; fails when it takes more steps. `watch` sees each sample.
  template <class Watch>
  void go(std::uint64_t most_steps, Watch&& watch, int every = 20, double load_change = 0) {
    rig_.sample_anew({std::uint64_t(every), load_change});
    if (!rig_.go(most_steps, watch))
      FAIL() << "the protocol did not end in " << most_steps << " steps: " << rig_.protocol().status();
    summary = rig_.summary.all;
  }
  void go(std::uint64_t most_steps, int every = 20, double load_change = 0) {
    go(
        most_steps, [](Simulation&) {}, every, load_change);
  }
  Simulation& simulation() { return rig_.simulation(); }

 private:
  ProtocolRig rig_;

 public:
  KeptCurves& rows = rig_.rows;
  std::map<std::string, Json> summary;
};

/// Volume average over pairs, walls and applied forces, positive in tension [Pa]: as the post-processor `stress` has
/// it.
inline Mat3 mean_stress(Simulation& sim) {
  const SimulationView v = sim.view();
  Mat3 sum = Mat3::Zero();
  const auto& x = v.particles.position;
  for (std::size_t k = 0; k < v.pairs.size(); ++k) {
    const PairForce& f = v.pairs.force[k];
    sum += (x[v.pairs.j[k]] - x[v.pairs.i[k]]) * Vec3(f.fx, f.fy, f.fz).transpose();
  }
  for (const WallContact& c : v.wall_contacts) sum += (c.point - x[c.particle]) * c.force.transpose();
  for (const Mat3& moment : v.particles.boundary_moment) sum += moment;
  return sum / v.specimen.volume;
}

}  // namespace breccia::testing
