// SPDX-License-Identifier: BSD-3-Clause
// What plugins see of a simulation.
#include <numeric>

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

namespace {

SimulationView at_this_time(const State& s) {
  SimulationView v;
  static_cast<Space&>(v) = s;
  v.initial_cell = s.reference_cell;
  v.time = s.time;
  v.time_step = s.time_step;
  v.step = s.step;
  return v;
}

}  // namespace

SimulationView Simulation::particles_here() const {
  SimulationView v = at_this_time(state_);
  v.particles = view_of(state_.particles);
  v.materials = state_.materials;
  v.specimen = state_.specimen;
  v.part = part_of_specimen(&others_);
  if (v.part) v.part->pairs = v.part->bonds = {};
  return v;
}

SimulationView Simulation::show(const State& s, Shown& shown) {
  SimulationView v = at_this_time(s);
  const Particles& p = s.particles;
  v.particles = view_of(p);
  v.particles.boundary_moment = shown.boundary_moment = boundary_moments(p);
  v.pairs = {s.pairs.i, s.pairs.j, s.pairs.rest_length, s.pairs.state, s.pairs.bond, s.pairs.force, s.pairs.moment, {}};
  for (const auto& c : s.pairs.columns) v.pairs.columns.emplace_back(c);
  const Bonds& b = s.bonds;
  v.bonds = {b.i, b.j, b.initial_distance, b.state, b.pair, b.crack_of, b.cracks};
  shown.walls.clear();
  for (const Wall& w : s.walls)
    shown.walls.push_back(
        {w.name, w.point, w.normal, w.velocity, w.displacement, w.force, w.normal_force, w.cylinder_radius, 0});
  shown.wall_contacts.clear();
  for (const WallTouch& t : s.wall_touches) {
    if (t.overlap <= 0) continue;
    const Vec3 arm = -(p.radius()[t.particle] - t.overlap) * facing(s.walls[t.wall], p.position()[t.particle]).normal;
    shown.wall_contacts.push_back({t.particle, t.wall, p.position()[t.particle] + arm, t.force});
    ++shown.walls[t.wall].contacts;
  }
  v.materials = s.materials;
  v.walls = shown.walls;
  v.wall_contacts = shown.wall_contacts;
  v.specimen = s.specimen;
  return v;
}

std::optional<PartOfSpecimen> Simulation::part_of_specimen(OtherParts* others) const {
  if (!link()) return {};
  const Particles& p = state_.particles;
  return PartOfSpecimen{others,
                        {p.first_own(), p.end_own()},
                        {first_counted(state_.pairs.i, p), state_.pairs.size()},
                        {first_counted(state_.bonds.i, p), state_.bonds.size()},
                        link()->rank(),
                        link()->ranks(),
                        parts_->first_row()};
}

SimulationView Simulation::part(OtherParts* others) {
  BRECCIA_ASSERT(pair_forces_known_);
  const EnergyLedger energy = ledger();
  SimulationView v = show(state_, shown_part_);
  v.energy = energy;
  if (!link()) return v;
  v.part = part_of_specimen(others);
  if (shown_part_.walls.empty()) return v;
  std::vector<std::int64_t> contacts;
  for (const WallView& w : shown_part_.walls) contacts.push_back(std::int64_t(w.contacts));
  link()->add(contacts);
  for (std::size_t w = 0; w < contacts.size(); ++w) shown_part_.walls[w].contacts = std::size_t(contacts[w]);
  return v;
}

SimulationView Simulation::whole(const SimulationView& part, bool everywhere) {
  if (!link()) return part;
  gather(everywhere);
  SimulationView v = show(state(), shown_whole_);
  v.energy = part.energy;
  return v;
}

SimulationView Simulation::view(bool everywhere) { return whole(part(nullptr), everywhere); }

std::size_t Simulation::all_bonds() const {
  if (!link()) return state_.bonds.size();
  const auto of_rank = link()->numbers_of_all(state_.bonds.size() - first_counted(state_.bonds.i, state_.particles));
  return std::accumulate(of_rank.begin(), of_rank.end(), std::size_t(0));
}

}  // namespace breccia
