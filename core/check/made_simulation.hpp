// SPDX-License-Identifier: BSD-3-Clause
/// A simulation made by hand, for trials and tests of what looks at one: no engine, no law, any state that one likes.
#pragma once

#include <vector>

#include "breccia/views.hpp"

namespace breccia {

constexpr std::size_t made_block = 16;  ///< particles that never come apart: there are not many

/// Owns what the spans of a SimulationView point to.
struct MadeSimulation {
  int dimension = 3;
  double thickness = 1;
  std::vector<Vec3> position, reference;
  std::vector<double> radius, mass;
  std::vector<Index> id;
  std::vector<Vec3> velocity, spin, resultant, torque, applied_force;
  std::vector<std::uint8_t> held;
  Cell cell;
  double time = 0, time_step = 1e-7;  // [s]
  std::uint64_t step = 0;
  std::vector<std::string> materials{"material"};

  std::vector<Index> pair_i, pair_j, pair_bond;
  std::vector<double> rest_length;
  std::vector<BondState> pair_state;
  std::vector<PairForce> force;

  std::vector<Index> bond_i, bond_j, bond_pair;
  std::vector<double> initial_distance;
  std::vector<Index> crack_of;
  std::vector<Crack> cracks;
  std::vector<BondState> bond_state;

  std::vector<WallContact> wall_contacts;
  SpecimenShape specimen;
  EnergyLedger energy;
  std::optional<PartOfSpecimen> part;

  Index add_particle(const Vec3& x, double r) {
    position.push_back(x);
    reference.push_back(x);
    radius.push_back(r);
    mass.push_back(r * r * r);
    id.push_back(Index(id.size()));
    for (auto* v : {&velocity, &spin, &resultant, &torque, &applied_force}) v->push_back(Vec3::Zero());
    held.push_back(0);
    return id.back();
  }
  /// A pair that was never glued, with the force on i.
  std::size_t add_pair(Index i, Index j, const Vec3& on_i = Vec3::Zero()) {
    const double distance = Space{dimension, thickness, cell}.branch(position[i], position[j]).norm();
    pair_i.push_back(i);
    pair_j.push_back(j);
    pair_bond.push_back(PairsView::no_bond);
    rest_length.push_back(distance);
    pair_state.push_back(BondState::unbonded);
    force.push_back({on_i.x(), on_i.y(), on_i.z(), 0.5 * (distance - radius[i] - radius[j])});
    return pair_i.size() - 1;
  }
  std::size_t add_bond(Index i, Index j, const Vec3& on_i = Vec3::Zero()) {
    const std::size_t pair = add_pair(i, j, on_i);
    pair_bond[pair] = Index(bond_i.size());
    pair_state[pair] = BondState::intact;
    bond_i.push_back(i);
    bond_j.push_back(j);
    bond_pair.push_back(Index(pair));
    initial_distance.push_back(rest_length[pair]);
    crack_of.push_back(BondsView::no_crack);
    bond_state.push_back(BondState::intact);
    return bond_i.size() - 1;
  }
  void break_bond(std::size_t bond, BondState how) {
    bond_state[bond] = how;
    crack_of[bond] = Index(cracks.size());
    cracks.push_back({1, position[bond_i[bond]], (position[bond_j[bond]] - position[bond_i[bond]]).normalized()});
    pair_state[bond_pair[bond]] = how;
  }
  void set_force(std::size_t pair, const Vec3& on_i) {
    force[pair].fx = on_i.x();
    force[pair].fy = on_i.y();
    force[pair].fz = on_i.z();
  }

  SimulationView view() const {
    SimulationView v;
    v.dimension = dimension;
    v.thickness = thickness;
    v.cell = v.initial_cell = cell;
    v.time = time;
    v.time_step = time_step;
    v.step = step;
    v.materials = materials;
    v.particles.velocity = velocity;
    v.particles.angular_velocity = spin;
    v.particles.force = resultant;
    v.particles.torque = torque;
    v.particles.applied_force = applied_force;
    v.particles.held = held;
    v.particles.position = position;
    v.particles.initial_position = reference;
    v.particles.radius = radius;
    v.particles.mass = mass;
    v.particles.id = id;
    v.pairs.i = pair_i;
    v.pairs.j = pair_j;
    v.pairs.bond = pair_bond;
    v.pairs.rest_length = rest_length;
    v.pairs.state = pair_state;
    v.pairs.force = force;
    v.bonds.i = bond_i;
    v.bonds.j = bond_j;
    v.bonds.pair = bond_pair;
    v.bonds.initial_distance = initial_distance;
    v.bonds.crack_of = crack_of;
    v.bonds.cracks = cracks;
    v.bonds.state = bond_state;
    v.wall_contacts = wall_contacts;
    v.specimen = specimen;
    v.energy = energy;
    v.part = part;
    v.block = made_block;
    return v;
  }
};

inline MadeSimulation without_pairs(MadeSimulation s) {
  for (auto* index : {&s.pair_i, &s.pair_j, &s.pair_bond, &s.bond_i, &s.bond_j, &s.bond_pair, &s.crack_of})
    index->clear();
  for (auto* length : {&s.rest_length, &s.initial_distance}) length->clear();
  for (auto* state : {&s.pair_state, &s.bond_state}) state->clear();
  s.force.clear();
  s.cracks.clear();
  return s;
}

}  // namespace breccia
