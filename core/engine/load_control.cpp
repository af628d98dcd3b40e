// SPDX-License-Identifier: BSD-3-Clause
// What a protocol may change and ask of a simulation.
#include <numeric>
#include <utility>

#include "breccia/protocol_tools/equilibrium.hpp"
#include "engine/cell_motion.hpp"
#include "engine/simulation.hpp"
#include "engine/specimen.hpp"
#include "engine/walls.hpp"

namespace breccia {

double Simulation::unbalanced_force_ratio() {
  BRECCIA_ASSERT(pair_forces_known_ && forces_known_);
  std::vector<std::uint8_t> held(state_.particles.size());
  for (std::size_t a = 0; a < held.size(); ++a)
    held[a] = (state_.particles.held[a] & ~(state_.dimension == 2 ? dof::out_of_plane : 0)) != 0;
  return breccia::unbalanced_force_ratio(state_.particles.force(), state_.pairs.force, held);
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
  BondStiffness result;
  std::size_t intact = 0;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.state[k] != BondState::intact) continue;
    ++intact;
    result.mean_normal += stiffness[k].normal;
    result.modulus += b.initial_distance[k] * b.initial_distance[k] * stiffness[k].normal;
  }
  if (intact == 0) return result;
  result.mean_normal /= double(intact);
  result.modulus /= state_.specimen.volume * state_.dimension;
  const auto m = state_.particles.mass();
  result.wave_speed = std::sqrt(result.modulus * state_.specimen.volume / std::accumulate(m.begin(), m.end(), 0.0));
  return result;
}

SpecimenShape Simulation::set_specimen_axis(const Vec3& axis) {
  const SpecimenShape& old = state_.specimen;
  state_.specimen =
      measure_specimen(state_.particles.position(), state_.particles.radius(), old.outline, axis, state_, old.volume);
  return state_.specimen;
}

void Simulation::mark_start_of_loading() {
  fold_chunk_sums();
  state_.energy = {};
  state_.dissipated.assign(laws_.size(), {});
  state_.energy.boundary_work = wall_work_ahead(state_) - led_work_behind(state_) - cell_work_behind(state_);
  state_.energy.initial = elastic_energy() + kinetic_energy(state_);
  const auto position = state_.particles.position();
  state_.particles.reference_position.assign(position.begin(), position.end());
  state_.reference_cell = state_.cell;
  for (Wall& w : state_.walls) w.displacement.setZero();
  const SpecimenShape& old = state_.specimen;
  state_.specimen = measure_specimen(state_.particles.position(), state_.particles.radius(), old.outline, old.axis,
                                     state_, old.volume);
  loading_started_ = true;
}

void Simulation::protect_bond(Index bond) {
  if (!laws_.respects_protection())
    throw UserError(
        "this test protects some bonds from breaking, and the contact law does not support that: protect no bonds, or "
        "use a law that has `respects_protection`");
  Bonds& b = state_.bonds;
  BRECCIA_ASSERT(bond < b.size() && rebuilds_ == 0);
  b.guarded.resize(b.size(), 0);
  b.guarded[bond] = 1;
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

void Simulation::hold(Index a, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity, const Vec3& arm) {
  Particles& p = state_.particles;
  p.held[a] |= mask;
  if (!arm.isZero(0) || !p.holding_arm.empty()) {
    p.holding_arm.resize(p.size(), Vec3::Zero());
    p.holding_arm[a] = arm;
  }
  // Whoever changes the velocity of a held particle gives it that energy.
  const auto lead = [&](double& now, double to, double inertia, int component) {
    if (to == now) return;
    state_.energy.boundary_work += 0.5 * inertia * (to * to - now * now);
    led_.push_back({a, component, to - now});
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
    const double load = l.component < 3 ? p.force()[l.particle][l.component] : p.torque()[l.particle][l.component - 3];
    state_.energy.boundary_work += 0.5 * state_.time_step * load * l.by;
  }
  led_.clear();
}

void Simulation::release(Index a, std::uint8_t mask) {
  const std::uint8_t always = state_.dimension == 2 ? dof::out_of_plane : std::uint8_t(0);
  const std::uint8_t held = std::uint8_t((state_.particles.held[a] & ~mask) | always);
  look_at_all_ |= settings_.time_step == TimeStep::spectral && rebuilds_ > 0 && held != state_.particles.held[a];
  state_.particles.held[a] = held;
}

void Simulation::set_applied_force(Index a, const Vec3& force, const Vec3& torque, const Mat3& moment) {
  Particles& p = state_.particles;
  /// Returns what it was before.
  const auto set = [&]<class T>(std::vector<T>& of, const T& value) -> T {
    if (of.empty() && value.isZero(0)) return value;
    of.resize(p.size(), T::Zero());
    return std::exchange(of[a], value);
  };
  loads_.add(a, force - set(p.applied_force, force), torque - set(p.applied_torque, torque));
  set(p.applied_moment, moment);
  any_applied_ = true;
}

}  // namespace breccia
