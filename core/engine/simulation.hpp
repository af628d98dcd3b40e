// SPDX-License-Identifier: BSD-3-Clause
/// The step loop: owns the state and everything that is derived from it.
#pragma once

#include <memory>

#include "breccia/protocol.hpp"
#include "engine/bonding.hpp"
#include "engine/neighbours.hpp"
#include "engine/particle_pass.hpp"
#include "engine/partition.hpp"
#include "engine/time_step.hpp"

namespace breccia {

struct EngineSettings {
  Damping damping;
  double safety = 0.8;  ///< share of the critical time step
  double skin = 0.3;    ///< of the neighbour list, in mean radii
  int threads = 1;
  std::string law = "contact_law";  ///< its name, for messages
};

class Simulation final : public LoadControl {
 public:
  /// Takes assembled particles; the law outlives the simulation.
  Simulation(State state, ContactLaw& law, const EngineSettings& settings);

  /// Makes the bonds and lets the law derive its constants.
  BondingResult bond(const BondingRule& rule);
  /// After bonds, walls and held particles are there: pair list and time step. UserError when nothing is stiff.
  void prepare();

  /// One step is `forces()` (resultants at the present time) then `advance()`; measure between the two. Each moves the
  /// springs and the ledger on by a step: one without the other is a mistake in the program, and said at once.
  /// A view may be taken only of a step that was told so: the force of each pair is not written to memory otherwise.
  void forces(bool to_be_viewed = true);
  void advance();
  bool forces_known() const { return forces_known_; }  ///< the resultants are those of the present positions

  SimulationView view();  ///< valid until the next call that changes anything
  const State& state() const { return state_; }
  std::uint64_t rebuilds() const { return rebuilds_; }
  double critical_step() const { return critical_; }
  /// After `prepare()`: the few particles, if any, whose bound is more than `ratio` times below that of the others.
  std::optional<StepSetter> step_setter(double ratio);
  bool loading_started() const { return loading_started_; }
  double porosity() const;  ///< 1 - sum of particle volumes / specimen volume

  std::size_t add_wall(const WallSpec& spec) override;
  void set_wall_velocity(std::size_t wall, const Vec3& velocity) override;
  void hold(Index particle, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity,
            const Vec3& arm = Vec3::Zero()) override;
  void release(Index particle, std::uint8_t mask) override;
  void set_applied_force(Index particle, const Vec3& force, const Mat3& moment) override;
  SpecimenShape set_specimen_axis(const Vec3& axis) override;
  void mark_start_of_loading() override;
  void protect_bond(Index bond) override;
  double time() const override { return state_.time; }
  double time_step() const override { return state_.time_step; }
  ParticlesView particles() const override;
  Vec3 wall_force(std::size_t wall) const override { return state_.walls.at(wall).force; }
  Vec3 wall_displacement(std::size_t wall) const override { return state_.walls.at(wall).displacement; }
  double wall_normal_force(std::size_t wall) const override { return state_.walls.at(wall).normal_force; }
  std::size_t broken_bonds() const override { return broken_; }
  double unbalanced_force_ratio() override;
  BondStiffness bond_stiffness() override;

 private:
  void rebuild();
  void look();
  void check_critical_step();
  void follow_neighbours();
  void record_breaks();
  void fold_chunk_sums();
  double elastic_energy();

  State state_;
  ContactLaw& law_;
  EngineSettings settings_;
  double skin_ = 0, reach_ = 0, critical_ = 0;
  Pairs spare_pairs_;  ///< of the last rebuild: its memory is used again
  Incidence incidence_;
  Partition partition_;
  std::vector<double*> columns_;
  std::vector<double> chunk_friction_, chunk_contact_, chunk_fracture_;
  std::vector<std::uint8_t> chunk_broke_;
  std::vector<std::uint8_t> guarded_pairs_;  ///< of `bonds.guarded`, for the present pair list
  std::vector<Vec3> external_force_, external_torque_;
  bool any_applied_ = false, loading_started_ = false, pair_forces_known_ = true, forces_known_ = false;
  std::uint64_t rebuilds_ = 0;
  std::size_t broken_ = 0;  ///< of the bonds
  std::vector<WallView> wall_views_;
  std::vector<Mat3> boundary_moment_;
  std::vector<WallContact> wall_contacts_;
};

}  // namespace breccia
