// SPDX-License-Identifier: BSD-3-Clause
/// What the step of the engine is measured against: the law `elastic_brittle` (model 1, spheres) written down as it
/// stands in a book. One loop over a fixed list of pairs, which gathers by index and stores the force of each pair; one
/// over the particles, which sums the forces of their pairs and moves them. One thread; no search, no walls, no plugin,
/// no second law. Shares no code with the engine, so that equal results say something about both.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/particle_pass.hpp"
#include "model/state.hpp"

namespace breccia {

/// As in the workflow.
struct PlainLaw {
  double bond_modulus, stiffness_ratio, tensile_strength, shear_strength, friction;  // [Pa], 1, [Pa], [Pa], 1
};

struct PlainParticle {
  double x[3], v[3], w[3];       // [m], [m/s], [rad/s]
  double radius, mass, inertia;  // [m], [kg], [kg m2]
};

/// On the first particle of a pair, the opposite on the second; torque per lever arm on either.
struct PlainForce {
  double force[3], torque_per_arm[3], half_gap, unused;  // [N], [N], [m]
};

struct PlainPairs {
  std::vector<std::uint32_t> i, j;
  std::vector<double> rest, spring_x, spring_y, spring_z;  // [m]
  std::vector<std::uint8_t> state;                         ///< as BondState has it
  std::vector<PlainForce> force;
};

class PlainKernel {
 public:
  /// The state of an engine before its first step.
  PlainKernel(const State& start, const PlainLaw& law, const Damping& damping);

  void step();

  const std::vector<PlainParticle>& particles() const { return particles_; }
  const PlainPairs& pairs() const { return pairs_; }
  const std::vector<double>& resultants() const { return force_; }  ///< three a particle, of the last step [N]
  double friction() const { return friction_; }                     ///< dissipated so far [J]
  double fracture() const { return fracture_; }
  double damped() const { return damped_; }

 private:
  PlainLaw law_;
  Damping damping_;
  double dt_;
  std::vector<PlainParticle> particles_;
  PlainPairs pairs_;
  std::vector<std::uint32_t> first_;  ///< of the entries of each particle
  std::vector<std::uint32_t> entry_;  ///< twice the pair; plus one where the particle is its second
  std::vector<double> force_;
  double friction_ = 0, fracture_ = 0, damped_ = 0;
};

}  // namespace breccia
