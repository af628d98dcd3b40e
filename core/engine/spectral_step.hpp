// SPDX-License-Identifier: BSD-3-Clause
/// The largest stable time step of the whole system, from its fastest mode.
#pragma once

#include "engine/archive_by_id.hpp"
#include "engine/stiffness_operator.hpp"

namespace breccia {

/// The dt at which the largest eigenvalue of M^-1 (dt^2/4 K + dt/2 C) is 1, K and C being stiffness and damping of the
/// whole system (see `time_step.hpp` for why that is where stability ends; without dashpots 2/omega_max).
///
/// Found by a locally optimal conjugate gradient iteration on the Rayleigh quotient (Knyazev 2001, one vector, no
/// preconditioner): as quick as Lanczos' method, but it needs three vectors only and its vector is there to start from
/// again. Any vector gives a step that is too long or right; the distance of the largest eigenvalue found to a true one
/// is at most the residual, by which the result is shortened. The start is a random vector, keyed by the particles'
/// numbers in the packing; sums are over blocks of particles, then exact: the same bits for any number of threads and
/// ranks. `link`: of a specimen in parts, at which all ranks look together; else null.
class SpectralStep {
 public:
  struct Result {
    double step;      ///< [s]
    double residual;  ///< of the eigenvalue, relative
    int products;     ///< of the system's matrix and a vector
  };

  /// Own particles that have come near something since the last look; all that have when none has been.
  std::vector<Index> changed(const State& state, double reach) const;
  /// From a random vector.
  Result estimate(State& state, const Interactions& law, const Incidence& incidence, double reach, int threads,
                  RankLink* link = nullptr);
  /// Whether `step` is still stable after `changed` have come near something: by each one's own bound, and by the
  /// fastest mode as it was. If not, the estimate that starts from that mode and a random vector of those particles.
  Result look(State& state, const Interactions& law, const Incidence& incidence, double reach, int threads,
              const std::vector<Index>& changed, double bound_of_changed, double step, RankLink* link = nullptr);

  int products() const { return products_; }  ///< in all: what the estimates cost
  void archive(SpecimenArchive& archive, std::size_t particles);

 private:
  friend class Simulation;  // which hands both on as particles change their ranks
  Result climb(const StiffnessOperator& system, const Particles& p, int threads, int at_least, RankLink* link);
  void remember(const State& state, double reach);

  std::vector<Vec6> mode_;                ///< the fastest one found, and a zero row
  std::vector<WallTouch> known_touches_;  ///< counted so far
  int products_ = 0;
};

}  // namespace breccia
