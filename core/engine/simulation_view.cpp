// SPDX-License-Identifier: BSD-3-Clause
// What plugins see of a simulation.
#include "engine/cell_motion.hpp"
#include "engine/particle_pass.hpp"
#include "engine/simulation.hpp"
#include "engine/walls.hpp"

namespace breccia {

namespace {

ParticlesView view_of(const Particles& p) {
  return {p.position(),
          p.velocity(),
          p.angular_velocity(),
          p.reference_position,
          p.force(),
          p.torque(),
          p.applied_force,
          {},
          p.radius(),
          p.mass(),
          p.held,
          p.id,
          p.material};
}

/// A force that holds a particle is the opposite of what the others do to it.
std::vector<Mat3> boundary_moments(const Particles& p) {
  std::vector<Mat3> moment = p.applied_moment;
  if (p.holding_arm.empty()) return moment;
  moment.resize(p.size(), Mat3::Zero());
  for (std::size_t a = 0; a < p.size(); ++a)
    for (int k = 0; k < 3; ++k)
      if (p.held[a] >> k & 1) moment[a].col(k) -= p.force()[a][k] * p.holding_arm[a];
  return moment;
}

}  // namespace

ParticlesView Simulation::particles() const {
  if (!link()) return view_of(state_.particles);
  see_particles();
  return view_of(*seen_);
}

/// Of a specimen in parts the first rank has the lists, the others what is no list.
SimulationView Simulation::view(bool everywhere) {
  BRECCIA_ASSERT(pair_forces_known_);
  const EnergyLedger energy = ledger();
  if (link()) gather(false, everywhere);
  const State& s = state();
  SimulationView v;
  v.energy = energy;
  static_cast<Space&>(v) = s;
  v.initial_cell = s.reference_cell;
  v.time = s.time;
  v.time_step = s.time_step;
  v.step = s.step;
  const Particles& p = s.particles;
  v.particles = view_of(p);
  v.particles.boundary_moment = boundary_moment_ = boundary_moments(p);
  v.pairs = {s.pairs.i, s.pairs.j, s.pairs.rest_length, s.pairs.state, s.pairs.bond, s.pairs.force, s.pairs.moment, {}};
  for (const auto& c : s.pairs.columns) v.pairs.columns.emplace_back(c);
  const Bonds& b = s.bonds;
  v.bonds = {b.i, b.j, b.initial_distance, b.state, b.pair, b.crack_of, b.cracks};
  wall_views_.clear();
  for (const Wall& w : s.walls)
    wall_views_.push_back(
        {w.name, w.point, w.normal, w.velocity, w.displacement, w.force, w.normal_force, w.cylinder_radius, 0});
  wall_contacts_.clear();
  for (const WallTouch& t : s.wall_touches) {
    if (t.overlap <= 0) continue;
    const Vec3 arm = -(p.radius()[t.particle] - t.overlap) * facing(s.walls[t.wall], p.position()[t.particle]).normal;
    wall_contacts_.push_back({t.particle, t.wall, p.position()[t.particle] + arm, t.force});
    ++wall_views_[t.wall].contacts;
  }
  v.materials = s.materials;
  v.walls = wall_views_;
  v.wall_contacts = wall_contacts_;
  v.specimen = s.specimen;
  return v;
}

}  // namespace breccia
