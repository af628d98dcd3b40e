// SPDX-License-Identifier: BSD-3-Clause
/// Plugin kind `protocol`: loads the specimen (walls, held particles, applied forces) and says when to stop.
#pragma once

#include "breccia/plugin.hpp"
#include "breccia/services.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// A rigid plane, or the inside of a rigid cylinder, that particles press on through a linear penalty spring and
/// Coulomb friction.
struct WallSpec {
  std::string name;
  Vec3 point = Vec3::Zero();    ///< of the plane, or of the cylinder's axis [m]
  Vec3 normal = Vec3::UnitZ();  ///< toward the specimen; of a cylinder the direction of its axis
  double normal_stiffness = 0;  ///< [N/m]
  double shear_stiffness = 0;   ///< [N/m]; 0 without friction
  double friction = 0;
  double cylinder_radius = 0;  ///< above zero: a cylinder of this radius, else a plane [m]
};

/// How stiff the bonds of a specimen are, from the law: for what must scale with the material instead of being tuned.
struct BondStiffness {
  double mean_normal = 0;  ///< mean normal stiffness of the bonds [N/m]
  double modulus =
      0;  ///< (1/V) sum over bonds of length^2 x normal stiffness/dimension: the order of Young's modulus [Pa]
  double wave_speed = 0;  ///< sqrt(modulus V/mass) [m/s]
};

/// What a protocol may change, before the first step and at each step.
class LoadControl {
 public:
  virtual std::size_t add_wall(const WallSpec& spec) = 0;  ///< only in `setup`
  virtual void set_wall_velocity(std::size_t wall, const Vec3& velocity) = 0;
  /// Holds the velocity components in `mask` (bits of `dof`) of a particle at the given values. `arm`: from its centre
  /// to where the holding force acts, for the mean stress [m].
  virtual void hold(Index particle, std::uint8_t mask, const Vec3& velocity, const Vec3& angular_velocity,
                    const Vec3& arm = Vec3::Zero()) = 0;
  virtual void release(Index particle, std::uint8_t mask) = 0;
  /// A force [N] and a torque about the centre [N m] on a particle; both stay until set again. `moment` says where the
  /// force acts, for the mean stress: the sum over its parts of (point - centre) (x) force [N m]. No torque is made of
  /// it. In two dimensions force and torque are those of the whole thickness, the torque about z.
  virtual void set_applied_force(Index particle, const Vec3& force, const Vec3& torque, const Mat3& moment) = 0;
  /// The specimen is loaded along this coordinate direction; by default along the axis of its packing. Only in `setup`.
  /// Returns what it measures along that axis.
  virtual SpecimenShape set_specimen_axis(const Vec3& axis) = 0;
  /// Starts the ledger of energies and the reference positions (displacements) afresh; rows of curves.csv begin here.
  virtual void mark_start_of_loading() = 0;
  /// From now on these bonds (rows of the BondsView that `setup` was shown) are neither damaged nor broken, whatever
  /// they carry. Only in `setup`; of parts all ask together, each for the bonds it sees, own and copied ones. UserError
  /// if there are any and the contact law cannot do this.
  virtual void protect_bonds(std::span<const Index> bonds) = 0;
  /// Of a space that repeats itself: how fast the vectors of its cell grow, as columns [m/s]. The specimen is strained
  /// as a whole: whenever this changes, all particles are given the change of velocity that goes with their place.
  virtual void set_cell_velocity(const Mat3& velocity) = 0;
  virtual Cell cell() const = 0;  ///< as the last step left it
  /// (1/V) sum over pairs of branch vector (x) force, in the last step, V the present volume of the cell; positive in
  /// tension [Pa]. Only of a space that repeats itself in all its directions.
  virtual Mat3 cell_stress() const = 0;
  virtual double time() const = 0;
  virtual double time_step() const = 0;
  /// As the last step left them; where there are several ranks, brought to each of them.
  virtual ParticlesView particles() const = 0;
  /// The same of those that this rank has, with space and specimen, but no pairs, bonds and walls. Each sum asked of it
  /// is a message; `step` and `decide`, which are called on all ranks, may ask.
  virtual SimulationView particles_here() const = 0;
  virtual Vec3 wall_force(std::size_t wall) const = 0;         ///< of the particles on the wall, in the last step [N]
  virtual Vec3 wall_displacement(std::size_t wall) const = 0;  ///< since the start of loading [m]
  /// Sum of the particles' normal forces on the wall, whatever their directions, in the last step [N].
  virtual double wall_normal_force(std::size_t wall) const = 0;
  virtual std::size_t broken_bonds() const = 0;
  /// Mean resultant on a particle that is not held over mean contact force; a pass over all pairs. Only from `decide`,
  /// in a step that the last `decide` asked to look at.
  virtual double unbalanced_force_ratio() = 0;
  virtual BondStiffness bond_stiffness() = 0;  ///< of the intact bonds; costs a pass over them

 protected:
  ~LoadControl() = default;
};

enum class Progress {
  running,
  look,  ///< the forces of the next step are wanted in full: to begin loading, or to measure how far from equilibrium
  finished  ///< the next step is the last: it gives the last row of the curves
};

class BRECCIA_API Protocol : public Plugin {
 public:
  static constexpr const char* kind = "protocol";
  /// Bonds exist; no step was made. Adds walls and columns.
  virtual void setup(const SimulationView& view, LoadControl& control, Recorder& recorder, Host& host) = 0;
  /// Before the forces of each step. Cheap: no allocation, no loop over particles unless needed.
  virtual void step(LoadControl& control) = 0;
  /// After the forces of each step, before the motion: whether loading begins, where the peak is, whether the test has
  /// ended. Nothing is decided elsewhere, hence nothing depends on how often the curves are sampled. Cheap, as `step`.
  /// The first step may be looked at without having asked.
  virtual Progress decide(LoadControl& control) = 0;
  /// How far the specimen is loaded, as `decide` left it: grows with the load, in any unit. Rows are added to the
  /// curves where it changes fast and at its peak, however rarely they are sampled. 0 throughout: nothing is added.
  virtual double load() const { return 0; }
  /// Of what size `load` is at the least once the specimen is loaded: changes of a small share of this do not matter.
  virtual double load_scale() const { return 0; }
  /// True: `setup`, `sample` and `finish` can see the part of a specimen that this rank of several has, and are called
  /// on all of them, together; what they put together they ask of `view.sum` and `view.max`, and what the first sets
  /// counts. False: all parts are brought together, for `setup` on all ranks, else on the first, which alone calls
  /// them. Particles are named to `LoadControl` by their rows in the whole, as its `particles()` has them; an own one
  /// of a part has `SimulationView::row_in_whole`. All ranks hold, release and load the same ones, whoever has them.
  virtual bool sees_parts() const { return false; }
  /// Fills its columns, of the instant of the last `decide`.
  virtual void sample(const SimulationView& view, Recorder& recorder) const = 0;
  virtual double share_done() const = 0;             ///< estimate, 0 to 1, for the progress bar
  virtual std::string status() const { return {}; }  ///< a few words for it ("stress 120 MPa")
  virtual void finish(const SimulationView&, const Curves&, Summary&) {}
};

}  // namespace breccia
