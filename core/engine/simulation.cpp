// SPDX-License-Identifier: BSD-3-Clause
#include "engine/simulation.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/cell_motion.hpp"
#include "engine/law_probe.hpp"
#include "engine/meeting_parts.hpp"
#include "engine/specimen.hpp"
#include "engine/walls.hpp"

namespace breccia {
namespace {

/// Pairs whose surfaces are this near (in mean radii) count for the time step; those of a longer list are looked at
/// again when they could have come so near. As long as the default skin.
constexpr double counted_reach = 0.3;

}  // namespace

Simulation::Simulation(State state, Interactions laws, const EngineSettings& settings)
    : state_(std::move(state)), laws_(std::move(laws)), settings_(settings) {
  state_.dissipated.resize(laws_.size());
  if (settings_.link) parts_.emplace(*settings_.link).begin(state_);
  const auto r = state_.particles.radius();
  std::vector<ExactSum> sums(2);
  for (const double one : r) {
    sums[0].add(one);
    sums[1].add(breccia::solid_volume({&one, 1, sizeof one}, state_));
  }
  const std::vector<double> all = totals(sums, link());
  mean_radius_ = all[0] / double(all_particles());
  skin_ = settings_.skin * mean_radius_;
  reach_ = std::min(settings_.skin, counted_reach) * mean_radius_;
  pair_length_ = 2 * largest_of_ranks(link(), *std::max_element(r.begin(), r.end())) + skin_;
  solid_volume_ = all[1];
  loads_.reset(state_);
}

BondingResult Simulation::bond(const BondingRule& rule, const std::optional<SpecimenToTell>& told) {
  // Laws that make no bonds: what would be bonded are the contacts by whose stiffness a test is led.
  const BondingResult chosen = choose_bonds(state_, rule, laws_.makes_bonds() ? state_.bonds : contacts_,
                                            parts_ ? &*parts_ : nullptr),
                      result = laws_.makes_bonds() ? chosen : BondingResult{};
  loads_.shift_to(state_.particles);
  Assembly a;
  a.dimension = state_.dimension;
  a.thickness = state_.thickness;
  MeetingParts others(link());
  a.part = part_of_specimen(&others);
  a.radius = state_.particles.radius();
  a.mass = state_.particles.mass();
  a.bond_i = state_.bonds.i;
  a.bond_j = state_.bonds.j;
  a.porosity = told ? told->porosity : porosity();
  a.coordination_number = told ? told->coordination_number : result.coordination_number;
  others.together([&] { laws_.prepare(a); });
  return result;
}

double Simulation::porosity() const { return 1 - solid_volume_ / state_.specimen.volume; }

void Simulation::prepare() {
  critical_ = bound_ = std::numeric_limits<double>::infinity();
  mass_pending_ = settings_.added_mass > 0;
  state_.positions_at_look.clear();  // all pairs are to be looked at
  rebuild();
  check_stiffness(state_, laws_);
  if (!std::isfinite(critical_) && reach_ < skin_) {  // nothing touches yet: what may do so some day sets the step
    reach_ = skin_;
    state_.positions_at_look.clear();
    look();
  }
  mass_pending_ = false;
  if (!std::isfinite(critical_) && any_rank(link(), state_.bonds.size() > 0))
    throw UserError("contact law " + laws_.names() +
                    " states no stiffness for any of the bonds: there is none to set a time step");
  if (!std::isfinite(critical_))
    throw UserError(
        "no bond or contact is stiff enough to set a time step: the particles do not touch; "
        "raise bonding.tolerance or use a denser packing");
}

std::optional<StepSetter> Simulation::step_setter(double ratio) {
  const auto found = find_step_setter(state_, laws_, incidence_, reach_, bound_, ratio, settings_.threads, link());
  if (found) gather(false);  // who asks wants to know more of it
  return found;
}

void Simulation::check_critical_step() {
  if (critical_ > 0) return;
  if (const auto blame = blame_stiffness(state_, laws_)) throw UserError(*blame);
  throw UserError(
      "the stiffness of the contacts over the mass of the particles is too large a number: check moduli, density and "
      "radii");
}

void Simulation::rebuild() {
  fold_accounts();
  if (link()) balance();
  rebuild_pairs(state_, laws_, skin_, settings_.threads);
  rebuild_wall_touches(state_, skin_);
  deal_pairs();
  // Rows that no wall touches any more go back to the applied force alone.
  loads_.reset(state_);
  look();
  ++rebuilds_;
}

/// What follows from the list of pairs.
void Simulation::deal_pairs() {
  incidence_ = make_incidence(state_, settings_.threads);
  chunks_ = make_chunks(state_);
  partition_ = make_partition(state_, incidence_, chunks_, settings_.threads);
  chunk_dissipated_.assign(chunks_.size() * laws_.size(), {});
  chunk_broke_.assign(chunks_.size(), 0);
  released_.assign(partition_.shares.size(), {});
  if (state_.cell.repeats()) chunk_cell_forces_.resize(chunks_.size());
  block_accounts_.assign(blocks_of(state_.particles), {});
  pairs_ = state_.pairs.size();
  if (link()) {
    const auto of_rank = link()->numbers_of_all(pairs_ - chunks_.start[chunks_.first_counted()]);
    pairs_ = std::accumulate(of_rank.begin(), of_rank.end(), std::size_t(0));
  }
  if (const auto& guarded = state_.bonds.guarded; !guarded.empty()) {
    guarded_pairs_.assign(state_.pairs.size(), 0);
    for (std::size_t k = 0; k < state_.pairs.size(); ++k)
      if (const Index b = state_.pairs.bond[k]; b != PairsView::no_bond) guarded_pairs_[k] = guarded[b];
  }
}

/// Asks those pairs for a shorter time step that have come near.
void Simulation::look() {
  // Only new neighbours and walls can ask for a shorter step, and it only shrinks: a longer one half-way is not worth
  // the jump.
  if (mass_pending_) add_mass_for_step();
  const bool spectral = settings_.time_step == TimeStep::spectral, all = state_.positions_at_look.empty();
  const std::vector<Index> changed = spectral ? spectral_.changed(state_, reach_) : newly_within_reach(state_, reach_);
  double bound = critical_time_step(state_, laws_, incidence_, changed, reach_, settings_.threads);
  if (link()) bound = link()->least_of(bound);
  bound_ = std::min(bound_, bound);
  if (!spectral || !(bound_ > 0 && std::isfinite(bound_))) {
    critical_ = std::min(critical_, bound);
  } else {
    const double step =
        all ? spectral_.estimate(state_, laws_, incidence_, reach_, settings_.threads, link()).step
            : spectral_.look(state_, laws_, incidence_, reach_, settings_.threads, changed, bound, critical_, link())
                  .step;
    critical_ = std::max(bound_, std::min(critical_, step));
  }
  check_critical_step();
  state_.time_step = share_of_critical() * critical_;
  const auto position = state_.particles.position();
  state_.positions_at_look.assign(position.begin(), position.end());
  state_.cell_at_look = state_.cell;
  state_.moved_since_look = state_.walls_moved_since_look = state_.strained_since_look = 0;
}

/// Non-viscous damping turns against the velocity of the last half step, which in the fastest mode points away from
/// rest as the force points to it: it stiffens that mode by 1 + alpha. The bound of single particles has room for that.
double Simulation::share_of_critical() const {
  const double alpha = std::max(settings_.damping.translational, settings_.damping.rotational);
  if (settings_.time_step == TimeStep::bound || !(alpha > 0)) return settings_.safety;
  return std::min(settings_.safety, 0.95 / std::sqrt(1 + alpha));
}

/// Before the first step is chosen: all that follows knows the particles with the masses they have then.
void Simulation::add_mass_for_step() {
  Particles& p = state_.particles;
  std::vector<double> factors, mass(p.mass().begin(), p.mass().end()),
      steps = time_step_of_each(state_, laws_, incidence_, reach_, settings_.threads);
  if (link()) {  // the order of all steps counts; it is asked for once
    steps = parts_->gathered_rows(steps, p, true);
    mass = parts_->gathered_rows(mass, p, true);
  }
  added_mass_ = add_mass(Strided<const double>(mass), steps, settings_.added_mass, factors);
  for (std::size_t a = 0; a < p.size(); ++a) {
    p.mass()[a] *= factors[p.row_of(a)];
    p.inertia()[a] *= factors[p.row_of(a)];
  }
  mass_pending_ = added_mass_.particles == 0;
}

void Simulation::follow_neighbours() {
  State& s = state_;
  if (link() && std::exchange(any_released_, false)) look_at_all_ = link()->any(look_at_all_);
  if (look_at_all_) {  // what was held moves again, and may swing faster than the rest
    look_at_all_ = false;
    s.positions_at_look.clear();
    look();
  }
  // The bound adds up the fastest particle of each step; only when it says "perhaps" are the true displacements looked
  // at.
  // The strain of a space that repeats itself brings two surfaces nearer by its share of their centres' distance.
  const auto closed = [&](double& moved, double walls, double strained, const std::vector<Vec3>& from, const Cell& cell,
                          double gap) {
    const double allowed = 0.9 * gap - strained * pair_length_;
    if (2 * moved <= allowed && moved + walls <= allowed) return false;
    moved = largest_displacement(s, from, cell, settings_.threads, link());
    return 2 * moved > 0.9 * allowed || moved + walls > 0.9 * allowed;
  };
  if (closed(s.moved_bound, s.walls_moved, s.strained, s.positions_at_rebuild, s.cell_at_rebuild, skin_)) rebuild();
  else if (reach_ < skin_ && closed(s.moved_since_look, s.walls_moved_since_look, s.strained_since_look,
                                    s.positions_at_look, s.cell_at_look, reach_))
    look();
}

void Simulation::forces(bool to_be_viewed) {
  State& s = state_;
  BRECCIA_ASSERT(!forces_known_);  // a second time would move springs and ledger on without a step
  forces_known_ = true;
  whole_.reset();
  seen_are_now_ = false;
  follow_neighbours();
  const std::size_t of_walls = wall_sums(s), of_cell = s.cell.repeats() ? 18 : 0;
  step_sums_.assign(of_walls + of_cell + (link() ? 1 : 0), ExactSum());  // the last: bonds that break
  PairBatch all = whole_batch(s, columns_);
  all.dissipated = chunk_dissipated_.data();
  all.chunk_broke = chunk_broke_.data();
  all.chunk_start = chunks_.start.data();
  if (!laws_.has_kinds()) all.material = nullptr;  // nobody asks
  if (!guarded_pairs_.empty()) all.guarded = guarded_pairs_.data();
  all.sum = s.particles.load.data();
  all.apart = partition_.apart.data();
  all.chunk_cut = partition_.chunk_cut.data();
  all.cut = partition_.cut.data();
  all.keep_force = pair_forces_known_ = to_be_viewed;
  if (s.cell.repeats()) all.cell_forces = chunk_cell_forces_.data();
  const std::size_t shares = partition_.shares.size();
#pragma omp parallel num_threads(settings_.threads)
  {
#pragma omp for schedule(static, 1) nowait
    for (std::size_t t = 0; t < shares; ++t) {
      const Share& share = partition_.shares[t];
      PairBatch mine = all;
      mine.begin = share.first_pair;
      mine.end = share.end_pair;
      mine.first_chunk = share.first_chunk;
      mine.released = &released_[t];
      clear_forces(s, share);
      if (mine.begin < mine.end) laws_.evaluate(mine);
    }
#pragma omp single  // the first to be through; at its end the others are, too
    wall_forces(s, loads_, std::span(step_sums_).first(of_walls));
#pragma omp for schedule(static, 1)
    for (std::size_t t = 0; t < shares; ++t) complete_forces(s, partition_.shares[t], partition_, incidence_, loads_);
  }
  const std::size_t broke = record_breaks();
  settle_led();
  if (of_cell) add_cell_forces(std::span(step_sums_).subspan(of_walls, of_cell));
  if (link()) step_sums_.back().add(double(broke));
  const std::vector<double> sums = totals(step_sums_, link());
  broken_ += link() ? std::size_t(sums.back()) : broke;
  take_wall_forces(s, std::span(sums).first(of_walls));
  if (of_cell) take_cell_forces(std::span(sums).subspan(of_walls, of_cell));
}

/// Those of a block's chunks in their order, then exactly.
void Simulation::add_cell_forces(std::span<ExactSum> sums) const {
  for (std::size_t b = 0; b < chunks_.blocks(); ++b) {
    CellForces block;
    for (std::size_t c = chunks_.block_start[b]; c < chunks_.block_start[b + 1]; ++c) {
      block.across += chunk_cell_forces_[c].across;
      block.virial += chunk_cell_forces_[c].virial;
    }
    for (int k = 0; k < 9; ++k) {
      sums[std::size_t(k)].add(block.across.data()[k]);
      sums[std::size_t(9 + k)].add(block.virial.data()[k]);
    }
  }
}

void Simulation::take_cell_forces(std::span<const double> of) {
  for (int k = 0; k < 9; ++k) {
    state_.cell_forces.across.data()[k] = of[std::size_t(k)];
    state_.cell_forces.virial.data()[k] = of[std::size_t(9 + k)];
  }
}

/// Returns how many of the bonds that are counted here broke.
std::size_t Simulation::record_breaks() {
  State& s = state_;
  std::size_t broke = 0;
  for (std::vector<Released>& of_share : released_) {
    for (const Released& r : of_share) {
      const Index b = s.pairs.bond[r.pair];
      if (b == PairsView::no_bond) continue;
      if (s.bonds.released.empty()) s.bonds.released.assign(s.bonds.size(), 0);
      s.bonds.released[b] += r.energy;
      if (s.bonds.crack_of[b] != BondsView::no_crack) s.bonds.cracks[s.bonds.crack_of[b]].energy += r.energy;
    }
    of_share.clear();
  }
  for (std::size_t c = 0; c < chunk_broke_.size(); ++c) {
    if (!chunk_broke_[c]) continue;
    chunk_broke_[c] = 0;
    for (std::size_t k = chunks_.start[c]; k < chunks_.start[c + 1]; ++k) {
      const Index b = s.pairs.bond[k];
      if (b == PairsView::no_bond || s.bonds.state[b] == s.pairs.state[k]) continue;
      const Index i = s.pairs.i[k];
      const Index j = s.pairs.j[k];
      const Vec3 branch = s.branch(s.particles.position()[i], s.particles.position()[j]);
      const double distance =
          std::sqrt(branch.x() * branch.x() + branch.y() * branch.y() + branch.z() * branch.z());  // as the loop has it
      const double half_gap = 0.5 * (distance - s.particles.radius()[i] - s.particles.radius()[j]);
      broke += c >= chunks_.first_counted() && !is_broken(s.bonds.state[b]) && is_broken(s.pairs.state[k]);
      s.bonds.state[b] = s.pairs.state[k];
      const Vec3 normal = branch.normalized();
      const Crack crack{s.time, s.particles.position()[i] + (s.particles.radius()[i] + half_gap) * normal, normal,
                        s.bonds.released.empty() ? 0 : s.bonds.released[b]};
      Index& row = s.bonds.crack_of[b];
      if (row == BondsView::no_crack) {
        row = Index(s.bonds.cracks.size());
        s.bonds.cracks.push_back(crack);
        if (link()) parts_->note_crack(s, b);
      } else {
        s.bonds.cracks[row] = crack;
      }
    }
  }
  return broke;
}

/// No test can be made of a few steps: a wall would be through the specimen before it was stopped.
void Simulation::refuse_long_way() const {
  constexpr double most = 0.05;
  if (const double strain = (state_.cell_velocity_asked * state_.cell.inverse()).norm() * state_.time_step;
      strain > most) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "in one time step of %.3g s the space would be strained by %.3g: check density, moduli and the rate "
                  "of strain for their units",
                  state_.time_step, strain);
    throw UserError(text);
  }
  const double height = state_.specimen.height;
  for (const Wall& w : state_.walls)
    if (const double way = w.velocity.norm() * state_.time_step; height > 0 && way > most * height) {
      char text[160];
      std::snprintf(text, sizeof text, "in one time step of %.3g s the wall `%s` would go %.3g m, and the specimen is ",
                    state_.time_step, w.name.c_str(), way);
      char rest[120];
      std::snprintf(rest, sizeof rest, "%.3g m high: check density, moduli and velocity for their units", height);
      throw UserError(std::string(text) + rest);
    }
}

void Simulation::advance() {
  State& s = state_;
  BRECCIA_ASSERT(forces_known_);
  refuse_long_way();
  forces_known_ = false;
  whole_.reset();
  seen_are_now_ = false;
  if (any_led_) fold_led();
  const CellMotion cell = s.cell.repeats() ? lead_cell(s, link()) : CellMotion{};
  double speed = integrate(s, settings_.damping, cell, any_applied_, settings_.threads, block_accounts_);
  if (link()) {
    speed = link()->largest_of(speed);
    link()->forward(s.particles.motion);
  }
  move_walls(s);
  move_cell(s);
  s.moved_bound += speed * s.time_step;
  s.moved_since_look += speed * s.time_step;
  if (!std::isfinite(s.moved_bound)) {
    undo_positions(s);
    if (const auto blame = blame_force(s, laws_)) throw UserError(*blame);
    throw UserError("the motion ran away (a velocity is no longer a finite number) at step " + std::to_string(s.step) +
                    "; lower engine.time_step_safety or check stiffness and density");
  }
  s.time += s.time_step;
  ++s.step;
}

}  // namespace breccia
