// SPDX-License-Identifier: BSD-3-Clause
// What of a simulation goes into a checkpoint. What can be computed again from it, and is then the same to the last
// bit, does not: lists by particle, chunks, shares of threads, the forces of pairs.
#include <algorithm>
#include <limits>

#include "engine/archive_by_id.hpp"
#include "engine/simulation.hpp"
#include "engine/specimen.hpp"

namespace breccia {
namespace {

void archive_particles(Archive& archive, Particles& p) {
  const Archive::Group group(archive, "particles");
  const std::vector<Index>& id = p.id;
  archive_by_id(archive, "position", p.position(), id);
  archive_by_id(archive, "velocity", p.velocity(), id);
  archive_by_id(archive, "angular_velocity", p.angular_velocity(), id);
  archive_by_id(archive, "radius", p.radius(), id);
  archive_by_id(archive, "mass", p.mass(), id);
  archive_by_id(archive, "inertia", p.inertia(), id);
  archive_by_id(archive, "force", p.force(), id);
  archive_by_id(archive, "torque", p.torque(), id);
  archive_by_id(archive, "reference_position", p.reference_position, id);
  archive_by_id(archive, "applied_force", p.applied_force, id);
  archive_by_id(archive, "applied_torque", p.applied_torque, id);
  archive_by_id(archive, "applied_moment", p.applied_moment, id);
  archive_by_id(archive, "holding_arm", p.holding_arm, id);
  archive_by_id(archive, "held", p.held, id);
  archive_by_id(archive, "material", p.material, id);
}

void archive_bonds(Archive& archive, Bonds& b, const std::vector<Index>& id, const std::vector<Index>& row) {
  const Archive::Group group(archive, "bonds");
  archive_particles(archive, "i", Strided<Index>(b.i), id, row);
  archive_particles(archive, "j", Strided<Index>(b.j), id, row);
  archive("pair", b.pair);
  archive("initial_distance", b.initial_distance);
  archive("state", b.state);
  archive("guarded", b.guarded);
  archive("crack_of", b.crack_of);
  archive.records("cracks", b.cracks, std::pair("time", &Crack::time), std::pair("position", &Crack::position),
                  std::pair("normal", &Crack::normal), std::pair("energy", &Crack::energy));
  archive("released", b.released);
}

void archive_pairs(Archive& archive, Pairs& q, const std::vector<Index>& id, const std::vector<Index>& row) {
  const Archive::Group group(archive, "pairs");
  archive("state", q.state);
  if (archive.reading()) {
    const std::size_t n = q.state.size();
    q.i.resize(n);
    q.j.resize(n);
    q.force.assign(n, PairForce{});
    if (!q.moment.empty()) q.moment.assign(n, Vec3::Zero());
  }
  archive_particles(archive, "i", Strided<Index>(q.i), id, row);
  archive_particles(archive, "j", Strided<Index>(q.j), id, row);
  archive("bond", q.bond);
  archive("rest_length", q.rest_length);
  archive("history", q.columns);
}

void archive_walls(Archive& archive, std::vector<Wall>& walls) {
  archive.records("walls", walls, std::pair("point", &Wall::point), std::pair("normal", &Wall::normal),
                  std::pair("velocity", &Wall::velocity), std::pair("previous_velocity", &Wall::previous_velocity),
                  std::pair("displacement", &Wall::displacement), std::pair("force", &Wall::force),
                  std::pair("normal_force", &Wall::normal_force), std::pair("cylinder_radius", &Wall::cylinder_radius));
}

void archive_specimen(Archive& archive, SpecimenShape& s) {
  const Archive::Group group(archive, "specimen");
  archive("outline", s.outline);
  archive("base", s.base);
  archive("axis", s.axis);
  archive("height", s.height);
  archive("extent", s.extent);
  archive("cross_section_area", s.cross_section_area);
  archive("volume", s.volume);
}

}  // namespace

void SpectralStep::archive(Archive& archive, const std::vector<Index>& id) {
  std::uint8_t there = !mode_.empty();
  archive("is_there", there);
  if (archive.reading()) mode_.assign(there ? id.size() + 1 : 0, Vec6::Zero());
  if (there) archive_by_id(archive, "mode", Strided<Vec6>(mode_.data(), id.size(), sizeof(Vec6)), id);
  archive_touches(archive, "known_touches", known_touches_, id, inverse_of(id));
  archive("products", products_);
}

/// Of a specimen in parts: read by all ranks, written by the first from what `gather()` has brought there.
void Simulation::archive(Archive& archive) {
  const std::size_t walls = state_.walls.size();
  const bool in_parts = link();
  if (in_parts && archive.reading()) join();
  if (in_parts && !archive.reading()) BRECCIA_ASSERT(whole_ && whole_->for_archive);
  const auto swap_whole = [&] {
    std::swap(state_, whole_->state);
    std::swap(spectral_, whole_->spectral);
    std::swap(loads_, whole_->loads);
    chunk_dissipated_.swap(whole_->chunk_dissipated);
    block_accounts_.swap(whole_->block_accounts);
  };
  if (link()) swap_whole();
  archive_state(archive);
  if (link()) swap_whole();
  else if (in_parts) cut();
  if (state_.walls.size() != walls)
    throw UserError("the test of the checkpoint has " + std::to_string(state_.walls.size()) + " walls, this one " +
                    std::to_string(walls) + ": with these values of its protocol it cannot go on from there");
}

void Simulation::archive_state(Archive& archive) {
  BRECCIA_ASSERT(!forces_known_ && led_.empty() && !mass_pending_ && (archive.reading() || !any_led_));
  State& s = state_;
  const std::vector<Index>& id = s.particles.id;
  archive("time", s.time);
  archive("time_step", s.time_step);
  archive("step", s.step);
  archive("cell", s.cell);
  archive("cell_velocity", s.cell_velocity);
  archive("cell_velocity_asked", s.cell_velocity_asked);
  archive("reference_cell", s.reference_cell);
  archive("cell_force_across", s.cell_forces.across);
  archive("cell_virial", s.cell_forces.virial);
  archive_particles(archive, s.particles);
  archive_walls(archive, s.walls);
  archive_specimen(archive, s.specimen);
  archive("energy", s.energy);
  archive.records("dissipated", s.dissipated, std::pair("friction", &Dissipated::friction),
                  std::pair("contact", &Dissipated::contact), std::pair("fracture", &Dissipated::fracture));
  archive("critical_step", critical_);
  archive("bound_step", bound_);
  archive("reach", reach_);
  archive("added_mass", added_mass_);
  archive("look_at_all", look_at_all_);
  archive("any_applied", any_applied_);
  archive("loading_started", loading_started_);
  archive("rebuilds", rebuilds_);
  archive("broken", broken_);
  archive_lists(archive);
  {
    const Archive::Group group(archive, "fastest_mode");
    spectral_.archive(archive, id);
  }
  const Archive::Group group(archive, "loads");
  loads_.archive(archive, id);
}

void Simulation::take_specimen(Archive& from) {
  BRECCIA_ASSERT(from.reading() && rebuilds_ == 0 && state_.walls.empty());
  State& s = state_;
  Particles& p = s.particles;
  const SpecimenShape packed = s.specimen;
  const std::vector<double> mass(p.mass().begin(), p.mass().end()), inertia(p.inertia().begin(), p.inertia().end());
  const std::vector<std::uint8_t> held = p.held;
  archive_state(from);
  // Mass may have been added for that test's time step.
  std::copy(mass.begin(), mass.end(), p.mass().begin());
  std::copy(inertia.begin(), inertia.end(), p.inertia().begin());
  added_mass_ = {};
  p.held = held;
  p.holding_arm.clear();
  p.applied_force.clear();
  p.applied_torque.clear();
  p.applied_moment.clear();
  s.walls.clear();
  s.wall_touches.clear();
  s.bonds.guarded.clear();
  guarded_pairs_.clear();
  any_applied_ = look_at_all_ = loading_started_ = false;
  rebuilds_ = 0;
  for (Crack& c : s.bonds.cracks) c.time -= s.time;  // before the test: below zero
  s.time = 0;
  s.step = 0;
  s.energy = {};
  s.dissipated.assign(laws_.size(), {});
  chunk_dissipated_.assign(chunk_dissipated_.size(), {});
  block_accounts_.assign(block_accounts_.size(), {});
  s.cell_velocity_asked.setZero();
  s.reference_cell = s.cell;
  p.reference_position.assign(p.position().begin(), p.position().end());
  s.specimen = measure_specimen(p.position(), p.radius(), packed.outline, packed.axis, s, packed.volume);
  spectral_ = {};
  loads_.reset(s);
}

void Simulation::adapt() {
  critical_ = bound_ = std::numeric_limits<double>::infinity();
  state_.positions_at_look.clear();
  rebuild();
}

void Simulation::archive_lists(Archive& archive) {
  State& s = state_;
  const std::vector<Index>&id = s.particles.id, row = inverse_of(id);
  archive_bonds(archive, s.bonds, id, row);
  archive_pairs(archive, s.pairs, id, row);
  archive_touches(archive, "wall_touches", s.wall_touches, id, row);
  archive_by_id(archive, "positions_at_rebuild", s.positions_at_rebuild, id);
  archive("cell_at_rebuild", s.cell_at_rebuild);
  archive("moved_bound", s.moved_bound);
  archive("walls_moved", s.walls_moved);
  archive("strained", s.strained);
  archive_by_id(archive, "positions_at_look", s.positions_at_look, id);
  archive("cell_at_look", s.cell_at_look);
  archive("moved_since_look", s.moved_since_look);
  archive("walls_moved_since_look", s.walls_moved_since_look);
  archive("strained_since_look", s.strained_since_look);
  if (archive.reading()) deal_pairs();
  // Not yet in the ledger: added up there when it is looked at, and at no other time.
  archive("chunk_dissipated", chunk_dissipated_);
  archive("block_accounts", block_accounts_);
  if (archive.reading()) led_work_ = {};
}

}  // namespace breccia
