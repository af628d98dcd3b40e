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

void archive_particles(SpecimenArchive& archive, Particles& p) {
  const Archive::Group group(archive.plain(), "particles");
  archive.by_id("position", p.position());
  archive.by_id("velocity", p.velocity());
  archive.by_id("angular_velocity", p.angular_velocity());
  archive.by_id("radius", p.radius());
  archive.by_id("mass", p.mass());
  archive.by_id("inertia", p.inertia());
  archive.by_id("force", p.force());
  archive.by_id("torque", p.torque());
  archive.by_id("reference_position", p.reference_position);
  archive.by_id("applied_force", p.applied_force);
  archive.by_id("applied_torque", p.applied_torque);
  archive.by_id("applied_moment", p.applied_moment);
  archive.by_id("holding_arm", p.holding_arm);
  archive.by_id("held", p.held);
  archive.by_id("material", p.material);
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

void SpectralStep::archive(SpecimenArchive& archive, std::size_t particles) {
  std::uint8_t there = !mode_.empty();
  archive.plain()("is_there", there);
  if (archive.reading()) mode_.assign(there ? particles + 1 : 0, Vec6::Zero());
  if (there) archive.by_id("mode", Strided<Vec6>(mode_.data(), particles, sizeof(Vec6)));
  archive.touches("known_touches", known_touches_);
  archive.plain()("products", products_);
}

void Simulation::archive(Archive& archive) {
  const std::size_t walls = state_.walls.size();
  archive_state(archive);
  if (archive.reading()) {
    whole_.reset();
    seen_.reset();
  }
  if (state_.walls.size() != walls)
    throw UserError("the test of the checkpoint has " + std::to_string(state_.walls.size()) + " walls, this one " +
                    std::to_string(walls) + ": with these values of its protocol it cannot go on from there");
}

void Simulation::archive_state(Archive& archive) {
  BRECCIA_ASSERT(!forces_known_ && led_.empty() && !mass_pending_ && (archive.reading() || !any_led_));
  State& s = state_;
  SpecimenArchive lists(archive, s.particles, parts_ ? &*parts_ : nullptr);
  if (lists.parts()) archive.reading() ? find_lists(lists) : count_lists(lists);
  archive("time", s.time);
  archive("time_step", s.time_step);
  archive("step", s.step);
  archive("cell", s.cell);
  archive("cell_velocity", s.cell_velocity);
  archive("cell_velocity_asked", s.cell_velocity_asked);
  archive("reference_cell", s.reference_cell);
  archive("cell_force_across", s.cell_forces.across);
  archive("cell_virial", s.cell_forces.virial);
  archive_particles(lists, s.particles);
  archive_walls(archive, s.walls);
  archive_specimen(archive, s.specimen);
  archive("energy", s.energy);
  archive.records("dissipated", s.dissipated, std::pair("friction", &Dissipated::friction),
                  std::pair("contact", &Dissipated::contact), std::pair("fracture", &Dissipated::fracture));
  archive("critical_step", critical_);
  archive("bound_step", bound_);
  archive("reach", reach_);
  archive("added_mass", added_mass_);
  if (link() && !archive.reading()) look_at_all_ = link()->any(look_at_all_);  // whose particle was released knows
  archive("look_at_all", look_at_all_);
  archive("any_applied", any_applied_);
  archive("loading_started", loading_started_);
  archive("rebuilds", rebuilds_);
  archive("broken", broken_);
  archive_lists(lists);
  {
    const Archive::Group group(archive, "fastest_mode");
    spectral_.archive(lists, s.particles.size());
  }
  const Archive::Group group(archive, "loads");
  loads_.archive(lists, s.particles);
}

void Simulation::take_specimen(Archive& from) {
  BRECCIA_ASSERT(from.reading() && rebuilds_ == 0 && state_.walls.empty());
  State& s = state_;
  Particles& p = s.particles;
  const SpecimenShape packed = s.specimen;
  struct Packed {
    double mass, inertia;
    std::uint8_t held;
  };
  std::vector<Packed> own;
  for (std::size_t a = p.first_own(); a < p.end_own(); ++a) own.push_back({p.mass()[a], p.inertia()[a], p.held[a]});
  archive_state(from);
  // Mass may have been added for that test's time step.
  for (std::size_t k = 0; k < own.size(); ++k) {
    const std::size_t a = p.first_own() + k;
    p.mass()[a] = own[k].mass;
    p.inertia()[a] = own[k].inertia;
    p.held[a] = own[k].held;
  }
  if (link()) {
    link()->forward(p.motion);
    link()->forward(p.held);
  }
  added_mass_ = {};
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
  s.specimen = measure_specimen(p.position(), p.radius(), packed.outline, packed.axis, s, packed.volume, link());
  spectral_ = {};
  loads_.reset(s);
}

void Simulation::adapt() {
  critical_ = bound_ = std::numeric_limits<double>::infinity();
  state_.positions_at_look.clear();
  rebuild();
}

/// Of a part: what is counted here of pairs and bonds, and where that stands in the lists of the whole.
void Simulation::count_lists(SpecimenArchive& archive) {
  const auto count = [&](const std::vector<Index>& i, SpecimenArchive::Listed& of) {
    of.counted = first_counted(i, state_.particles);
    of.share = archive.counted_share(i.size() - of.counted);
  };
  count(state_.pairs.i, archive.pairs);
  count(state_.bonds.i, archive.bonds);
}

/// Of a part: its pairs and bonds, and copies of all that they meet. What was known before of either goes.
void Simulation::find_lists(SpecimenArchive& archive) {
  State& s = state_;
  s.pairs = Pairs{};
  s.bonds = Bonds{};
  s.wall_touches.clear();
  spectral_.known_touches_.clear();
  std::vector<Index> met;
  for (Index row = parts_->first_row(); row < parts_->end_row(); ++row) met.push_back(row);
  for (const auto* of : {&contacts_.i, &contacts_.j})
    for (const Index a : *of) met.push_back(s.particles.row_of(a));
  std::vector<Index> pair_i, pair_j, bond_i, bond_j;
  {
    const Archive::Group group(archive.plain(), "pairs");
    archive.find_rows(pair_i, pair_j, archive.pairs);
  }
  {
    const Archive::Group group(archive.plain(), "bonds");
    archive.find_rows(bond_i, bond_j, archive.bonds);
  }
  for (const auto* of : {&pair_i, &pair_j, &bond_i, &bond_j}) met.insert(met.end(), of->begin(), of->end());
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  parts_->place(s, contacts_, met);
  parts_->link().forward(s.particles.id);
  const auto name = [&](Index row) { return here(row); };
  const std::pair<std::vector<Index>*, std::vector<Index>*> lists[] = {
      {&pair_i, &s.pairs.i}, {&pair_j, &s.pairs.j}, {&bond_i, &s.bonds.i}, {&bond_j, &s.bonds.j}};
  for (const auto& [rows, to] : lists) {
    to->resize(rows->size());
    std::transform(rows->begin(), rows->end(), to->begin(), name);
  }
}

void Simulation::archive_bonds(SpecimenArchive& archive) {
  Bonds& b = state_.bonds;
  const Archive::Group group(archive.plain(), "bonds");
  archive.rows("i", b.i, archive.bonds);
  archive.rows("j", b.j, archive.bonds);
  archive.links("pair", b.pair, archive.bonds, archive.pairs);
  archive.list("initial_distance", b.initial_distance, archive.bonds);
  archive.list("state", b.state, archive.bonds);
  archive.list("guarded", b.guarded, archive.bonds);
  const std::vector<Index> cracks = archive.cracks(b);
  archive.list("released", b.released, archive.bonds);
  if (archive.parts() && archive.reading()) parts_->know_cracks(cracks);
}

void Simulation::archive_pairs(SpecimenArchive& archive) {
  Pairs& q = state_.pairs;
  const Archive::Group group(archive.plain(), "pairs");
  archive.list("state", q.state, archive.pairs);
  archive.rows("i", q.i, archive.pairs);
  archive.rows("j", q.j, archive.pairs);
  archive.links("bond", q.bond, archive.pairs, archive.bonds);
  archive.list("rest_length", q.rest_length, archive.pairs);
  archive.lists("history", q.columns, archive.pairs);
  if (!archive.reading()) return;
  q.force.assign(q.size(), PairForce{});
  if (laws_.has_moments()) q.moment.assign(q.size(), Vec3::Zero());
}

void Simulation::archive_lists(SpecimenArchive& lists) {
  State& s = state_;
  Archive& archive = lists.plain();
  archive_bonds(lists);
  archive_pairs(lists);
  if (lists.parts() && archive.reading()) link_bonds(s.pairs, s.bonds);
  lists.touches("wall_touches", s.wall_touches);
  lists.by_id("positions_at_rebuild", s.positions_at_rebuild);
  archive("cell_at_rebuild", s.cell_at_rebuild);
  archive("moved_bound", s.moved_bound);
  archive("walls_moved", s.walls_moved);
  archive("strained", s.strained);
  lists.by_id("positions_at_look", s.positions_at_look);
  archive("cell_at_look", s.cell_at_look);
  archive("moved_since_look", s.moved_since_look);
  archive("walls_moved_since_look", s.walls_moved_since_look);
  archive("strained_since_look", s.strained_since_look);
  if (archive.reading()) deal_pairs();
  archive_accounts(lists);
  if (archive.reading()) led_work_ = {};
}

/// Not yet in the ledger: added up there when it is looked at, and at no other time.
void Simulation::archive_accounts(SpecimenArchive& lists) {
  const auto archive = [&]<class T>(std::string_view name, std::span<T> own) {
    std::vector<T> records(own.begin(), own.end());
    lists.own_records(name, records);
    if (any_rank(link(), records.size() != own.size()))
      throw UserError("the accounts of energies are not those of these particles");
    std::copy(records.begin(), records.end(), own.begin());
  };
  archive("chunk_dissipated", std::span(chunk_dissipated_).subspan(chunks_.first_counted() * laws_.size()));
  archive("block_accounts", std::span(block_accounts_));
}

}  // namespace breccia
