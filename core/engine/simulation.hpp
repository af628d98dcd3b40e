// SPDX-License-Identifier: BSD-3-Clause
/// The step loop: owns the state and everything that is derived from it.
#pragma once

#include <memory>
#include <optional>

#include "breccia/protocol.hpp"
#include "engine/added_mass.hpp"
#include "engine/bonding.hpp"
#include "engine/meeting_parts.hpp"
#include "engine/neighbours.hpp"
#include "engine/particle_pass.hpp"
#include "engine/partition.hpp"
#include "engine/parts.hpp"
#include "engine/spectral_step.hpp"
#include "engine/time_step.hpp"

namespace breccia {

/// How the critical time step is found: each particle's own bound, or the system's fastest mode.
enum class TimeStep { bound, spectral };

struct EngineSettings {
  Damping damping;
  TimeStep time_step = TimeStep::bound;
  double safety = 0.8;    ///< share of the critical time step
  double skin = 0.3;      ///< of the neighbour list, in mean radii
  double added_mass = 0;  ///< share of the total mass that may be added for a longer time step
  int threads = 1;
  RankLink* link = nullptr;  ///< to the other ranks of the job; null where there is none. Outlives the simulation
};

/// What the laws are told of the specimen instead of what the engine measures: of a pair that is driven by itself.
struct SpecimenToTell {
  double porosity = 0, coordination_number = 0;
};

class Simulation final : public LoadControl {
 public:
  /// Takes assembled particles; the laws outlive the simulation.
  Simulation(State state, Interactions laws, const EngineSettings& settings);

  /// Makes the bonds, if a law makes any, and lets the laws derive their constants.
  BondingResult bond(const BondingRule& rule, const std::optional<SpecimenToTell>& told = {});
  /// After bonds, walls and held particles are there: pair list and time step. UserError when nothing is stiff.
  void prepare();

  /// One step is `forces()` (resultants at the present time) then `advance()`; measure between the two. Each moves the
  /// springs and the ledger on by a step: one without the other is a mistake in the program, and said at once.
  /// A view may be taken only of a step that was told so: the force of each pair is not written to memory otherwise.
  void forces(bool to_be_viewed = true);
  void advance();
  bool forces_known() const { return forces_known_; }  ///< the resultants are those of the present positions

  /// Valid until the next call that changes anything. Of a specimen in parts: on the first rank, or everywhere; the
  /// others then see no lists.
  SimulationView view(bool everywhere = false);
  /// The same of what this rank has of a specimen in parts, without bringing them together; all ranks call it together.
  /// `others`: through whom its plugins ask for sums, may be null where nobody does. Where there is one rank, all of
  /// it.
  SimulationView part(OtherParts* others);
  /// Of such a part the whole, brought together on the first rank, or everywhere; all ranks call it together. The
  /// others then see no lists.
  SimulationView whole(const SimulationView& part, bool everywhere = false);
  /// Of a specimen in parts this rank's; on the first rank all of it from `view()` until the next call that changes
  /// anything; the others then see no lists.
  const State& state() const { return whole_ ? whole_->state : state_; }
  std::size_t pairs() const { return pairs_; }  ///< of the whole specimen, when the list was made
  std::size_t all_particles() const { return parts_ ? parts_->rows() : state_.particles.size(); }
  std::size_t all_bonds() const;  ///< ever made, of the whole specimen; all ranks ask together
  /// How often all was brought together on the first rank.
  int gatherings() const { return gatherings_; }
  double seconds_gathering() const { return seconds_gathering_; }  ///< so far, for views and for protocols that look
  int changes_of_ranks() const { return parts_ ? parts_->changes() : 0; }  ///< of particles, as work shifted
  std::uint64_t rebuilds() const { return rebuilds_; }
  double critical_step() const { return critical_; }
  double step_over_bound() const { return critical_ / bound_; }  ///< critical step over that of single particles
  const AddedMass& added_mass() const { return added_mass_; }
  int mode_products() const { return spectral_.products(); }  ///< matrix-vector products that the step has cost
  double fastest_boundary();                                  ///< of walls, held particles and the cell [m/s]
  /// After `prepare()`: the few particles, if any, whose bound is more than `ratio` times below that of the others.
  std::optional<StepSetter> step_setter(double ratio);
  bool loading_started() const { return loading_started_; }
  double solid_volume() const { return solid_volume_; }  ///< sum of the particles' volumes; overlaps count twice [m3]
  double porosity() const;                               ///< 1 - that / specimen volume

  /// Between a step's `advance()` and the next one's `forces()`: all that the steps to come depend on. Read into a
  /// simulation of the same packing, bonds, laws and walls, on which `prepare()` was called; any number of threads and
  /// ranks: all read and write together, each its share of the lists, through an archive that has `SharedLists`.
  /// UserError when it has another number of walls.
  void archive(Archive& archive);
  /// After `bond()`: the particles, bonds and contacts of such a state, of the same packing, bonds and laws, for
  /// another test. What loaded them there is gone, the clock stands at 0, the specimen is measured anew. `prepare()`
  /// follows.
  void take_specimen(Archive& from);
  /// After `archive` has read what was written with other parameters or settings: the time step and the pair list are
  /// made as these ask.
  void adapt();
  double energy_of_pairs();  ///< that all pairs store in the present positions [J]

  std::size_t add_wall(const WallSpec& spec) override;
  void set_wall_velocity(std::size_t wall, const Vec3& velocity) override;
  void hold(Index particle, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity,
            const Vec3& arm = Vec3::Zero()) override;
  void release(Index particle, std::uint8_t mask) override;
  void set_applied_force(Index particle, const Vec3& force, const Vec3& torque, const Mat3& moment) override;
  SpecimenShape set_specimen_axis(const Vec3& axis) override;
  void mark_start_of_loading() override;
  void set_cell_velocity(const Mat3& velocity) override;
  Cell cell() const override { return state_.cell; }
  Mat3 cell_stress() const override;
  void protect_bonds(std::span<const Index> bonds) override;
  double time() const override { return state_.time; }
  double time_step() const override { return state_.time_step; }
  ParticlesView particles() const override;
  SimulationView particles_here() const override;
  Vec3 wall_force(std::size_t wall) const override { return state_.walls.at(wall).force; }
  Vec3 wall_displacement(std::size_t wall) const override { return state_.walls.at(wall).displacement; }
  double wall_normal_force(std::size_t wall) const override { return state_.walls.at(wall).normal_force; }
  std::size_t broken_bonds() const override { return broken_; }
  double unbalanced_force_ratio() override;
  BondStiffness bond_stiffness() override;

 private:
  /// The link when the specimen is in parts, else null: all that is here is all there is.
  RankLink* link() const { return parts_ ? &parts_->link() : nullptr; }
  static constexpr Index elsewhere = Parts::elsewhere;
  Index here(Index row) const;  ///< of a row of the whole; or `elsewhere`
  std::optional<Index> bond_here(Index row_i, Index row_j) const;
  std::optional<PartOfSpecimen> part_of_specimen(OtherParts* others) const;
  void balance();
  void deal_again();
  void gather(bool everywhere);
  void see_particles() const;
  void rebuild();
  void deal_pairs();
  void archive_state(Archive& archive);
  void archive_lists(SpecimenArchive& archive);
  void count_lists(SpecimenArchive& archive);
  void find_lists(SpecimenArchive& archive);
  void archive_bonds(SpecimenArchive& archive);
  void archive_pairs(SpecimenArchive& archive);
  void archive_accounts(SpecimenArchive& archive);
  void look();
  void add_mass_for_step();
  double share_of_critical() const;
  void check_critical_step();
  void follow_neighbours();
  void refuse_long_way() const;
  std::size_t record_breaks();
  void fold_accounts();
  void fold_led();
  void add_cell_forces(std::span<ExactSum> sums) const;
  void take_cell_forces(std::span<const double> totals);
  void settle_led();
  void add_energy_of_pairs(ExactSum& to);
  void blame();
  void fail_together(const std::optional<std::string>& here) const;
  EnergyLedger ledger();
  void begin_ledger();

  State state_;
  Interactions laws_;
  EngineSettings settings_;
  double solid_volume_ = 0, mean_radius_ = 0;  // [m3], [m]
  double skin_ = 0, reach_ = 0, critical_ = 0, bound_ = 0;
  Bonds contacts_;          ///< at the start, where no law makes bonds: for `bond_stiffness`
  double pair_length_ = 0;  ///< how far apart the centres of two neighbours are at the most [m]
  SpectralStep spectral_;
  AddedMass added_mass_;
  bool mass_pending_ = false, look_at_all_ = false;
  Incidence incidence_;
  Chunks chunks_;
  Partition partition_;
  std::optional<Parts> parts_;  ///< where there are other ranks
  mutable LinkedParts others_;  ///< of a protocol that asks in a step
  /// The specimen brought together, until something changes.
  struct Whole {
    State state;
    bool everywhere = false;
  };
  std::unique_ptr<Whole> whole_;
  mutable std::optional<Particles> seen_;  ///< those of all ranks, for a protocol
  mutable bool seen_are_now_ = false;
  mutable double seconds_gathering_ = 0;
  int gatherings_ = 0;
  std::size_t pairs_ = 0;
  std::vector<double*> columns_;
  std::vector<Dissipated> chunk_dissipated_;  ///< of each chunk, law by law, since the ledger was looked at
  std::vector<BlockAccount> block_accounts_;  ///< of each block of own particles, likewise
  std::vector<ExactSum> step_sums_;
  std::vector<std::uint8_t> chunk_broke_;
  std::vector<std::vector<Released>> released_;  ///< in this step, of each share; empty between steps
  std::vector<CellForces> chunk_cell_forces_;    ///< of each chunk; none where space does not repeat itself
  std::vector<std::uint8_t> guarded_pairs_;      ///< of `bonds.guarded`, for the present pair list
  ExternalLoads loads_;
  /// A component of a held particle's velocity (0 to 2) or spin (3 to 5) that was changed.
  struct Led {
    Index particle;  ///< row in the whole specimen
    int component;
    double by;
  };
  std::vector<Led> led_;  ///< before the forces were known
  ExactSum led_work_;     ///< of those who led particles, not yet in the ledger
  bool any_led_ = false, any_released_ = false;
  bool any_applied_ = false, loading_started_ = false, pair_forces_known_ = true, forces_known_ = false;
  std::uint64_t rebuilds_ = 0;
  std::size_t broken_ = 0;  ///< of the bonds
  /// What views show that is not in the state as they show it.
  struct Shown {
    std::vector<WallView> walls;
    std::vector<Mat3> boundary_moment;
    std::vector<WallContact> wall_contacts;
  };
  static SimulationView show(const State& state, Shown& shown);
  Shown shown_part_, shown_whole_;
};

}  // namespace breccia
