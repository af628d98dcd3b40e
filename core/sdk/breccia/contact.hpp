// SPDX-License-Identifier: BSD-3-Clause
/// What passes between the engine and a contact law.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "breccia/si_unit.hpp"
#include "breccia/views.hpp"

/// Kernel functions must end up inside the vector loop.
#define BRECCIA_KERNEL inline __attribute__((always_inline))

// One binary, the widest vectors the machine has. Bits agree between them (-ffp-contract=off). Sanitizers cannot
// cope with the resolver functions that this makes.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    defined(__x86_64__)
#define BRECCIA_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define BRECCIA_VECTOR_CLONES
#endif

namespace breccia {

/// The geometry and motion of one pair, as its law sees it. n points from i to j.
struct Contact {
  double distance;             ///< of the centres [m]
  double rest_length;          ///< bonded: distance when the bond was made; others: min(first distance, r_i + r_j) [m]
  double radius_i, radius_j;   // [m]
  double nx, ny, nz;           ///< unit normal
  double mid_x, mid_y, mid_z;  ///< unit normal in the middle of the step that led here, where the velocities belong
  double normal_velocity;      ///< rate of the distance [m/s]
  /// Tangential motion of j relative to i at the contact point in this step, carried to the present plane [m].
  double shear_x, shear_y, shear_z;
  double spin;                    ///< mean rotation of the two about n in this step [rad]
  double turn_x, turn_y, turn_z;  ///< rotation of j relative to i in this step, carried likewise [rad]
  double intact;                  ///< 1 while the bond holds, else 0
  double
      breakable;  ///< 1 while the bond holds and may fail; 0 also if the protocol protects it (`respects_protection`)
  double normal_force;  ///< of the laws that stand before this one in the list, tension positive; 0 for the first [N]
  double reduced_mass;  ///< m_i m_j/(m_i + m_j) [kg]
  double time_step;     // [s]

  BRECCIA_KERNEL double touching() const {
    return radius_i + radius_j;
  }  ///< distance of the centres when the surfaces touch [m]
  /// Distance below which the two press on each other without a bond: when they touch, or, if they overlapped more when
  /// the pair was made, from there on [m].
  BRECCIA_KERNEL double free_length() const {
    const double sum = radius_i + radius_j;
    return rest_length < sum ? rest_length : sum;
  }
};

/// What a law answers. Tension is positive; shear and moment act on i, their opposites on j.
struct ContactForce {
  double normal = 0;                                // [N]
  double shear_x = 0, shear_y = 0, shear_z = 0;     // [N]
  double moment_x = 0, moment_y = 0, moment_z = 0;  ///< only when `has_moments` [N m]
  double breaks = 0;                                ///< 0, or the BondState it breaks into, as a number
  double friction_work = 0;                         ///< dissipated by sliding in this step [J]
  double contact_work = 0;                          ///< dissipated otherwise (viscous, plastic, damage) [J]
  double fracture_energy = 0;                       ///< stored energy lost because it broke in this step [J]
};

/// Linearised stiffness for the time step: translations [N/m], rotations [N m/rad]; and the constant of a dashpot along
/// the normal [N s/m].
struct ContactStiffness {
  double normal = 0, shear = 0, bending = 0, torsion = 0;
  double damping = 0;
  double shear_damping = 0;  ///< the same across the normal [N s/m]

  friend ContactStiffness operator+(const ContactStiffness& a, const ContactStiffness& b) {
    return {a.normal + b.normal,   a.shear + b.shear,     a.bending + b.bending,
            a.torsion + b.torsion, a.damping + b.damping, a.shear_damping + b.shear_damping};
  }
};

/// One member of a law's State; `columns` names each of them once.
template <class State>
struct StateColumn {
  double State::*member;
  const char* name;  ///< another one for each
  SiUnit unit;
};

/// A constant of a law's kernel that goes with (or against) a parameter of its configuration, which the workflow may
/// give as a distribution: then each bond has a value of its own. In the law:
///   static constexpr auto per_bond() { return std::array{PerBond<MyLaw>{"tensile_strength", &MyLaw::strength}}; }
template <class Law>
struct PerBond {
  const char* parameter;  ///< may stand with several constants
  double Law::*member;    ///< proportional to the parameter
  bool inverse = false;   ///< to one over it
};

/// What a law may know of the whole specimen when it derives its constants. Of one that several ranks share the lists
/// are those of a part: what is averaged over them is asked of all parts, as of a `SimulationView`.
struct Assembly : SeenInPart {
  int dimension = 3;
  double thickness = 1;                   // [m]
  Strided<const double> radius, mass;     // [m], [kg]
  std::span<const Index> bond_i, bond_j;  ///< rows of these
  double porosity = 0, coordination_number = 0;
  OwnRows own_particles() const { return part ? part->particles : OwnRows(0, radius.size()); }
  OwnRows own_bonds() const { return part ? part->bonds : OwnRows(0, bond_i.size()); }
};

}  // namespace breccia
