// SPDX-License-Identifier: BSD-3-Clause
// What a protocol may change and ask of a simulation.
#include <algorithm>
#include <utility>

#include "breccia/protocol_tools/equilibrium.hpp"
#include "engine/cell_motion.hpp"
#include "engine/simulation.hpp"
#include "engine/specimen.hpp"
#include "engine/walls.hpp"

namespace breccia {
namespace {

void see_held(Particles& p, Index row, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity) {
  p.held[row] |= mask;
  for (int k = 0; k < 3; ++k) {
    if (mask >> k & 1) p.velocity()[row][k] = velocity[k];
    if (mask >> (k + 3) & 1) p.angular_velocity()[row][k] = angular_velocity[k];
  }
}

}  // namespace

double Simulation::unbalanced_force_ratio() {
  BRECCIA_ASSERT(pair_forces_known_ && forces_known_);
  const Particles& p = state_.particles;
  const std::uint8_t free_to_hold = state_.dimension == 2 ? dof::out_of_plane : 0;
  const auto counts = [&](std::size_t a) { return (p.held[a] & ~free_to_hold) == 0; };
  std::vector<ExactSum> sums(4);
  add_block_by_block(p, sums[0], [&](std::size_t a) { return counts(a) ? p.force()[a].norm() : 0.0; });
  add_block_by_block(p, sums[1], [&](std::size_t a) { return counts(a) ? 1.0 : 0.0; });
  for (std::size_t b = 0; b < chunks_.blocks(); ++b) {
    double contact = 0, contacts = 0;
    for (std::size_t k = chunks_.start[chunks_.block_start[b]]; k < chunks_.start[chunks_.block_start[b + 1]]; ++k) {
      const PairForce& f = state_.pairs.force[k];
      const double size = std::sqrt(f.fx * f.fx + f.fy * f.fy + f.fz * f.fz);
      contact += size;
      contacts += size > 0;
    }
    sums[2].add(contact);
    sums[3].add(contacts);
  }
  const std::vector<double> all = totals(sums, link());
  return all[2] > 0 && all[1] > 0 ? all[0] / all[1] / (all[2] / all[3]) : 0.0;
}

double Simulation::fastest_boundary() {
  const State& s = state_;
  double fastest = 0;
  for (const Wall& w : s.walls) fastest = std::max(fastest, w.velocity.norm());
  for (int k = 0; k < 3; ++k) fastest = std::max(fastest, s.cell_velocity.col(k).norm());
  for (std::size_t a = 0; a < s.particles.size(); ++a)
    for (int k = 0; k < 3; ++k)
      if (s.particles.held[a] >> k & 1) fastest = std::max(fastest, std::abs(s.particles.velocity()[a][k]));
  return largest_of_ranks(link(), fastest);
}

BondStiffness Simulation::bond_stiffness() {
  const Bonds& b = laws_.makes_bonds() ? state_.bonds : contacts_;
  std::vector<BondState> bond_state = b.state;
  if (!laws_.makes_bonds()) bond_state.assign(b.size(), BondState::unbonded);
  std::vector<double*> columns;
  PairBatch batch = whole_batch(state_, columns);
  batch.begin = 0;
  batch.end = b.size();
  batch.i = b.i.data();
  batch.j = b.j.data();
  batch.rest_length = b.initial_distance.data();
  batch.state = bond_state.data();
  // Of bonds as they were made, with what each was given: pairs may not be there yet.
  std::vector<std::vector<double>> history(laws_.columns(), std::vector<double>(b.size()));
  columns.clear();
  for (auto& c : history) columns.push_back(c.data());
  batch.columns = columns.data();
  laws_.initialise(batch);
  std::vector<ContactStiffness> stiffness(b.size());
  laws_.stiffness(batch, stiffness.data());
  std::vector<ExactSum> sums(4);
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.state[k] != BondState::intact || b.i[k] < state_.particles.first_own()) continue;
    sums[0].add(1);
    sums[1].add(stiffness[k].normal);
    sums[2].add(b.initial_distance[k] * b.initial_distance[k] * stiffness[k].normal);
  }
  add_block_by_block(state_.particles, sums[3], [&](std::size_t a) { return state_.particles.mass()[a]; });
  const std::vector<double> all = totals(sums, link());
  BondStiffness result;
  if (all[0] == 0) return result;
  result.mean_normal = all[1] / all[0];
  result.modulus = all[2] / (state_.specimen.volume * state_.dimension);
  result.wave_speed = std::sqrt(result.modulus * state_.specimen.volume / all[3]);
  return result;
}

SpecimenShape Simulation::set_specimen_axis(const Vec3& axis) {
  const SpecimenShape& old = state_.specimen;
  state_.specimen = measure_specimen(state_.particles.position(), state_.particles.radius(), old.outline, axis, state_,
                                     old.volume, link());
  return state_.specimen;
}

void Simulation::mark_start_of_loading() {
  begin_ledger();
  whole_.reset();
  seen_.reset();
  const auto position = state_.particles.position();
  state_.particles.reference_position.assign(position.begin(), position.end());
  state_.reference_cell = state_.cell;
  for (Wall& w : state_.walls) w.displacement.setZero();
  const SpecimenShape& old = state_.specimen;
  state_.specimen = measure_specimen(state_.particles.position(), state_.particles.radius(), old.outline, old.axis,
                                     state_, old.volume, link());
  loading_started_ = true;
}

void Simulation::protect_bonds(std::span<const Index> bonds) {
  if (!any_rank(link(), !bonds.empty())) return;
  if (!laws_.respects_protection())
    throw UserError(
        "this test protects some bonds from breaking, and the contact law does not support that: protect no bonds, or "
        "use a law that has `respects_protection`");
  BRECCIA_ASSERT(rebuilds_ == 0);
  Bonds& b = state_.bonds;
  b.guarded.resize(b.size(), 0);
  for (const Index bond : bonds) {
    if (const Whole* const shown = whole_ && whole_->everywhere ? whole_.get() : nullptr) {
      const Bonds& seen = shown->state.bonds;
      BRECCIA_ASSERT(bond < seen.size());
      if (const auto at = bond_here(seen.i[bond], seen.j[bond])) b.guarded[*at] = 1;
    } else {
      BRECCIA_ASSERT(bond < b.size());
      b.guarded[bond] = 1;
    }
  }
}

void Simulation::set_cell_velocity(const Mat3& velocity) {
  BRECCIA_ASSERT(state_.cell.repeats() || velocity.isZero(0));
  state_.cell_velocity_asked = velocity;
}

Mat3 Simulation::cell_stress() const {
  BRECCIA_ASSERT(state_.repeats_all_round());
  return state_.cell_forces.virial / state_.cell_volume();
}

std::size_t Simulation::add_wall(const WallSpec& w) {
  for (int k = 0; k < 3; ++k)
    if (state_.cell.repeats(k) && (w.cylinder_radius > 0) != (std::abs(w.normal[k]) > 1e-9))
      throw UserError(std::string("the wall `") + w.name + "` stands across " + "xyz"[k] +
                      ", along which space repeats itself: take " + "xyz"[k] +
                      " out of `periodic`, or test along another axis");
  Wall wall;
  wall.name = w.name;
  wall.point = w.point;
  wall.normal = w.normal.normalized();
  wall.velocity = wall.previous_velocity = wall.displacement = wall.force = Vec3::Zero();
  wall.normal_stiffness = w.normal_stiffness;
  wall.shear_stiffness = w.shear_stiffness;
  wall.friction = w.friction;
  wall.cylinder_radius = w.cylinder_radius;
  state_.walls.push_back(wall);
  return state_.walls.size() - 1;
}

void Simulation::set_wall_velocity(std::size_t wall, const Vec3& velocity) {
  state_.walls.at(wall).velocity = velocity;
}

Index Simulation::here(Index row) const { return link() ? Parts::here(state_.particles, row) : row; }

/// Of two rows of the whole.
std::optional<Index> Simulation::bond_here(Index row_i, Index row_j) const {
  const Bonds& b = state_.bonds;
  const std::pair ends(here(row_i), here(row_j));
  Index low = 0, high = Index(b.size());
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (std::pair(b.i[middle], b.j[middle]) < ends) low = middle + 1;
    else high = middle;
  }
  if (low == b.size() || std::pair(b.i[low], b.j[low]) != ends) return {};
  return low;
}

void Simulation::hold(Index row, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity,
                      const Vec3& arm) {
  Particles& p = state_.particles;
  const Index a = here(row);
  any_led_ = true;
  if (!arm.isZero(0) || !p.holding_arm.empty()) {
    p.holding_arm.resize(p.size(), Vec3::Zero());
    if (a != elsewhere) p.holding_arm[a] = arm;
  }
  if (seen_) see_held(*seen_, row, mask, velocity, angular_velocity);
  if (a == elsewhere) return;
  p.held[a] |= mask;
  // Whoever changes the velocity of a held particle gives it that energy.
  const auto lead = [&](double& now, double to, double inertia, int component) {
    if (to == now) return;
    if (p.own(a)) {
      led_work_.add(0.5 * inertia * (to * to - now * now));
      led_.push_back({row, component, to - now});
    }
    now = to;
  };
  for (int k = 0; k < 3; ++k) {
    if (mask >> k & 1) lead(p.velocity()[a][k], velocity[k], p.mass()[a], k);
    if (mask >> (k + 3) & 1) lead(p.angular_velocity()[a][k], angular_velocity[k], p.inertia()[a], k + 3);
  }
  if (forces_known_) settle_led();
}

/// The half step before a particle was led to another velocity was at the old one, against the forces of the present
/// positions: who leads it before these are known (a protocol does) is charged when they are.
void Simulation::settle_led() {
  const Particles& p = state_.particles;
  for (const Led& l : led_) {
    const Index a = here(l.particle);
    const double load = l.component < 3 ? p.force()[a][l.component] : p.torque()[a][l.component - 3];
    led_work_.add(0.5 * state_.time_step * load * l.by);
  }
  led_.clear();
}

void Simulation::release(Index row, std::uint8_t mask) {
  const Index a = here(row);
  any_released_ = true;
  const std::uint8_t always = state_.dimension == 2 ? dof::out_of_plane : std::uint8_t(0);
  if (seen_) seen_->held[row] = std::uint8_t((seen_->held[row] & ~mask) | always);
  if (a == elsewhere) return;
  const std::uint8_t held = std::uint8_t((state_.particles.held[a] & ~mask) | always);
  look_at_all_ |= settings_.time_step == TimeStep::spectral && rebuilds_ > 0 && held != state_.particles.held[a];
  state_.particles.held[a] = held;
}

void Simulation::set_applied_force(Index row, const Vec3& force, const Vec3& torque, const Mat3& moment) {
  const Index a = here(row);
  const std::size_t n = state_.particles.size();
  /// Returns what it was before.
  const auto set = [&]<class T>(std::vector<T>& of, const T& value) -> T {
    if (of.empty() && value.isZero(0)) return value;
    of.resize(n, T::Zero());  // everywhere, wherever the particle is
    return a == elsewhere ? value : std::exchange(of[a], value);
  };
  Particles& p = state_.particles;
  const Vec3 more = force - set(p.applied_force, force), turn = torque - set(p.applied_torque, torque);
  if (a != elsewhere && p.own(a)) loads_.add(a, more, turn);
  set(p.applied_moment, moment);
  any_applied_ = true;
  if (seen_ && !force.isZero(0)) seen_->applied_force.resize(seen_->size(), Vec3::Zero());
  if (seen_ && !seen_->applied_force.empty()) seen_->applied_force[row] = force;
}

}  // namespace breccia
