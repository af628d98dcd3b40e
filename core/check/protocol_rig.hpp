// SPDX-License-Identifier: BSD-3-Clause
/// A protocol on a small specimen, stepped as a run would step it, with nothing else around: for trials and tests.
#pragma once

#include <memory>
#include <optional>

#include "breccia/packing.hpp"
#include "check/kept.hpp"
#include "run/energy_check.hpp"
#include "run/loading.hpp"

namespace breccia {

struct RigSettings {
  int dimension = 3;
  double thickness = 1;       // [m]
  double bonding_gap = 1e-6;  ///< relative
  int threads = 1;
  Sampling sampling = {20, 0};
  double damping = 0.5;  ///< non-viscous, of motion and rotation
};

class ProtocolRig {
 public:
  /// `protocol` was made and not yet set up.
  ProtocolRig(const Registry& registry, const PackedParticles& packing, const PluginStack& laws,
              std::unique_ptr<Protocol> protocol, const RigSettings& settings);

  /// One step. `last`: the run is stopped in it.
  LoadingStep step(bool last = false);
  /// To the protocol's end; whether it came within `most` steps. `watch` sees each row.
  template <class Watch>
  bool go(std::uint64_t most, Watch&& watch) {
    for (std::uint64_t k = 0; k < most; ++k) {
      const LoadingStep now = step();
      if (now.row) watch(*simulation_);
      if (now.ends) return true;
    }
    return false;
  }
  bool go(std::uint64_t most) {
    return go(most, [](Simulation&) {});
  }
  void sample_anew(const Sampling& sampling);  ///< before the first step

  /// Between two steps: all but the rows. False when the protocol does not say what changes in it.
  bool archive(Archive& archive);

  Simulation& simulation() { return *simulation_; }
  Protocol& protocol() { return *protocol_; }
  std::uint64_t steps() const { return simulation_->state().step; }
  /// What was unaccounted for at the most, over the largest energy of the whole test so far: the first steps, in which
  /// everything is fast and small, do not stand for the others.
  double energy_error() const { return energy_.share(energy_error_, 0); }
  KeptCurves rows;
  KeptSummary summary;

 private:
  SilentHost host_;
  std::optional<ContactLaws> laws_;
  std::unique_ptr<Protocol> protocol_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<Loading> loading_;
  EnergyCheck energy_;
  double energy_error_ = 0;  // [J]
  bool moved_ = true;        ///< the step's forces are not yet known
};

}  // namespace breccia
