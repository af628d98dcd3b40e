// SPDX-License-Identifier: BSD-3-Clause
/// Small specimens of every form, for the trials of plugins: lattices, or disordered ones, of spheres or discs that all
/// touch or nearly touch their neighbours.
#pragma once

#include "breccia/packing.hpp"
#include "check/made_simulation.hpp"

namespace breccia {

struct MadeForm {
  std::string name;  ///< "3D, cylinder"
  int dimension = 3;
  SpecimenShape::Outline outline = SpecimenShape::Outline::box;
  bool periodic = false;  ///< in all its directions
};

/// Boxes and round ones, in space and in the plane, and such as repeat themselves.
const std::vector<MadeForm>& made_forms();

constexpr double made_radius = 1e-3;  ///< [m]
constexpr double made_bonding_gap =
    0.2;  ///< relative gap up to which neighbours of the lattice are bonded, and no others
constexpr double made_thickness = 0.01;  ///< of discs [m]

/// Standing on its base like what a packing fills; without disorder a square or cubic lattice of equal particles.
PackedParticles made_packing(const MadeForm& form, bool disorder);

/// That specimen bonded, at rest.
MadeSimulation made_simulation(const PackedParticles& packing, int dimension);

/// Moves every particle by gradient (x - base) + shift from where it was at the start, and gives the pairs the forces
/// of central springs, of which broken ones push only. Time and ledger go on with it.
void displace(MadeSimulation& simulation, const Mat3& gradient, const Vec3& shift, double time);

/// The same simulation with particles, pairs and bonds in another order; `order[k]` is the old number of particle k.
MadeSimulation reordered(const MadeSimulation& simulation, const std::vector<Index>& order);

}  // namespace breccia
