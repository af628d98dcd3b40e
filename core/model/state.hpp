// SPDX-License-Identifier: BSD-3-Clause
/// The whole state of a simulation as one plain object: arrays and numbers, no pointers, no caches. What is here is
/// what a checkpoint needs; what can be computed again from it (neighbour cells, incidence lists) is not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "breccia/types.hpp"
#include "breccia/views.hpp"

namespace breccia {

/// What a pair needs to know of a particle, in one place: a pair meets its particles wherever they stand in memory, and
/// each place costs a cache line. Three vectors of four numbers, see `engine/four.hpp`.
struct alignas(32) ParticleMotion {
  Vec3 position = Vec3::Zero();          // [m]
  double mass = 0;                       // [kg]
  Vec3 velocity = Vec3::Zero();          ///< in the middle of the last step [m/s]
  double inertia = 0;                    // [kg m2]
  Vec3 angular_velocity = Vec3::Zero();  ///< in the middle of the last step [rad/s]
  double radius = 0;                     // [m]
};

/// Where pairs add to: a cache line. Undamped resultants of the last force evaluation.
struct alignas(64) ParticleLoad {
  Vec3 force = Vec3::Zero();  // [N]
  double unused = 0;
  Vec3 torque = Vec3::Zero();  // [N m]
  double unused_too = 0;
};

/// One row per particle, in spatial (Morton) order.
struct Particles {
  std::vector<ParticleMotion> motion;
  std::vector<ParticleLoad> load;
  std::vector<Vec3> reference_position;  ///< at the start of loading [m]
  std::vector<Vec3> applied_force;       ///< by the protocol [N]; empty until there is one
  std::vector<Vec3> applied_torque;      ///< the same [N m]
  std::vector<Mat3> applied_moment;      ///< (point - centre) (x) force [N m]; empty until there is one
  std::vector<Vec3> holding_arm;       ///< from the centre to where a holding force acts [m]; empty until there is one
  std::vector<std::uint8_t> held;      ///< bits of `dof`
  std::vector<Index> id;               ///< row in the packing
  std::vector<std::uint8_t> material;  ///< row of `State::materials`; empty when there is but one
  /// Of a part of a specimen (`engine/parts.hpp`): which rows of the whole these are, ascending; empty when they are
  /// all there are. The own ones stand side by side, between copies of those of other parts that they meet.
  std::vector<Index> row;
  std::size_t copies_before = 0, copies_behind = 0;
  std::size_t size() const { return motion.size(); }
  std::size_t first_own() const { return copies_before; }
  std::size_t end_own() const { return size() - copies_behind; }
  bool own(std::size_t a) const { return a >= first_own() && a < end_own(); }
  Index row_of(std::size_t a) const { return row.empty() ? Index(a) : row[a]; }
  /// How much farther back the own ones stand in the whole.
  std::size_t shift() const {
    return row.empty() || copies_before >= row.size() ? 0 : row[copies_before] - copies_before;
  }

  Strided<Vec3> position() { return member(motion, &ParticleMotion::position); }
  Strided<Vec3> velocity() { return member(motion, &ParticleMotion::velocity); }
  Strided<Vec3> angular_velocity() { return member(motion, &ParticleMotion::angular_velocity); }
  Strided<double> mass() { return member(motion, &ParticleMotion::mass); }
  Strided<double> inertia() { return member(motion, &ParticleMotion::inertia); }
  Strided<double> radius() { return member(motion, &ParticleMotion::radius); }
  Strided<Vec3> force() { return member(load, &ParticleLoad::force); }
  Strided<Vec3> torque() { return member(load, &ParticleLoad::torque); }
  Strided<const Vec3> position() const { return member(motion, &ParticleMotion::position); }
  Strided<const Vec3> velocity() const { return member(motion, &ParticleMotion::velocity); }
  Strided<const Vec3> angular_velocity() const { return member(motion, &ParticleMotion::angular_velocity); }
  Strided<const double> mass() const { return member(motion, &ParticleMotion::mass); }
  Strided<const double> inertia() const { return member(motion, &ParticleMotion::inertia); }
  Strided<const double> radius() const { return member(motion, &ParticleMotion::radius); }
  Strided<const Vec3> force() const { return member(load, &ParticleLoad::force); }
  Strided<const Vec3> torque() const { return member(load, &ParticleLoad::torque); }

 private:
  template <class Record, class T>
  static Strided<T> member(std::vector<Record>& of, T Record::*which) {
    return {of.empty() ? nullptr : &(of.data()->*which), of.size(), sizeof(Record)};
  }
  template <class Record, class T>
  static Strided<const T> member(const std::vector<Record>& of, T Record::*which) {
    return {of.empty() ? nullptr : &(of.data()->*which), of.size(), sizeof(Record)};
  }
};

/// Pairs that the force loop visits, sorted by (i, j) with i < j.
struct Pairs {
  std::vector<Index> i, j;
  std::vector<Index> bond;          ///< row in Bonds or PairsView::no_bond
  std::vector<double> rest_length;  // [m]
  std::vector<BondState> state;
  std::vector<std::vector<double>> columns;  ///< the law's history
  std::vector<PairForce> force;
  std::vector<Vec3> moment;  ///< empty unless the law has moments
  std::size_t size() const { return i.size(); }
};

/// Every bond ever made, sorted by (i, j).
struct Bonds {
  std::vector<Index> i, j, pair;
  std::vector<double> initial_distance;  // [m]
  std::vector<BondState> state;
  std::vector<std::uint8_t> guarded;  ///< 1: must not break; empty when there are none
  std::vector<Index> crack_of;        ///< row in `cracks` or BondsView::no_crack
  std::vector<Crack> cracks;          ///< few bonds break
  std::vector<double> released;       ///< what each released so far as it broke [J]; empty while none has
  std::size_t size() const { return i.size(); }
};

/// A rigid plane, or the inside of a rigid cylinder about the line through `point` along `normal`; moved by the
/// protocol.
struct Wall {
  std::string name;
  Vec3 point, normal, velocity, previous_velocity, displacement, force;
  double normal_stiffness, shear_stiffness, friction;
  double cylinder_radius = 0;  ///< 0: a plane [m]
  double normal_force = 0;     ///< sum over the particles that press on it [N]
};

/// A particle near a wall, with the spring of its friction.
struct WallTouch {
  Index particle, wall;
  Vec3 spring = Vec3::Zero();  // [m]
  Vec3 force = Vec3::Zero();   ///< on the particle [N]
  double overlap = 0;          ///< positive when pressed [m]
};

/// What contacts have dissipated [J].
struct Dissipated {
  double friction = 0;  ///< by sliding
  double contact = 0;   ///< otherwise (viscous, plastic, damage)
  double fracture = 0;  ///< stored energy of bonds that broke
};

/// Sums of the ledger that cannot be computed from the present state.
struct EnergySums {
  double boundary_work = 0, friction = 0, damping = 0, contact = 0, fracture = 0;  // [J]
  double initial = 0;  ///< elastic + kinetic at the start of loading [J]
};

/// Sums over all pairs of a space that repeats itself: f is the force on i, b the branch vector.
struct CellForces {
  Mat3 across = Mat3::Zero();  ///< f (x) the cells that b is shorter by than the difference of the positions [N]
  Mat3 virial = Mat3::Zero();  ///< b (x) f [J]
};

struct State : Space {
  double time = 0, time_step = 0;  // [s]
  std::uint64_t step = 0;
  /// How fast the vectors of the cell grow: in the half step behind, and from the next motion on [m/s].
  Mat3 cell_velocity = Mat3::Zero(), cell_velocity_asked = Mat3::Zero();
  Cell reference_cell;  ///< at the start of loading
  CellForces cell_forces;
  Particles particles;
  Pairs pairs;
  Bonds bonds;
  std::vector<Wall> walls;
  std::vector<WallTouch> wall_touches;  ///< sorted by (wall, particle)
  std::vector<Vec3> positions_at_rebuild;
  Cell cell_at_rebuild;
  double moved_bound = 0, walls_moved = 0, strained = 0;  ///< since the pair list was made [m], [m], [1]
  std::vector<Vec3> positions_at_look;                    ///< when the pairs that set the time step were last looked at
  Cell cell_at_look;
  double moved_since_look = 0, walls_moved_since_look = 0, strained_since_look = 0;  // [m], [m], [1]
  EnergySums energy;
  std::vector<Dissipated> dissipated;  ///< since the start of loading, one per contact law; walls are not in it
  SpecimenShape specimen;
  std::vector<std::string> materials;  ///< names
};

}  // namespace breccia
