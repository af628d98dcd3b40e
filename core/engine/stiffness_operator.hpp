// SPDX-License-Identifier: BSD-3-Clause
/// The linearised stiffness and damping of the whole system, as products with a vector.
#pragma once

#include "engine/contact_stiffness.hpp"
#include "engine/neighbours.hpp"

namespace breccia {

/// All intact bonds, and pairs and wall touches within `reach` [m], counted as active; held components do not move.
class StiffnessOperator {
 public:
  /// `link`: of a specimen in parts; rows of own particles are whole then.
  StiffnessOperator(State& state, const Interactions& law, const Incidence& incidence, double reach, int threads,
                    RankLink* link = nullptr);

  std::size_t size() const { return inverse_mass_.size(); }  ///< particles
  bool damped() const { return damped_; }
  /// Masses of the six components of a particle; infinite ones (held) have the inverse 0.
  double inverse_mass(std::size_t a, int component) const {
    return component < 3 ? (held_[a] >> component & 1 ? 0.0 : inverse_mass_[a])
                         : (held_[a] >> component & 1 ? 0.0 : inverse_inertia_[a]);
  }

  /// The rows of particle `a` in M^-1 K u and, with dashpots, M^-1 C u. `u` has a row more than there are particles,
  /// which is zero: what walls do. The order of the sum is that of the pairs, whoever asks.
  void row(std::size_t a, const Vec6* u, Vec6& stiffness, Vec6& damping) const;

 private:
  struct End {
    ContactEnd end;
    Index other;
  };
  std::vector<std::size_t> start_;
  std::vector<End> ends_;
  std::vector<double> inverse_mass_, inverse_inertia_;
  std::vector<std::uint8_t> held_;
  bool damped_ = false, moments_ = false;
};

}  // namespace breccia
