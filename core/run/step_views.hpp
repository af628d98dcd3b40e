// SPDX-License-Identifier: BSD-3-Clause
/// What plugins see of one step: each rank its part, or the first rank all of it.
#pragma once

#include <optional>

#include "engine/meeting_parts.hpp"
#include "engine/simulation.hpp"

namespace breccia {

/// All ranks make it and use it together. The parts are brought together when somebody is shown the whole, and only
/// then.
class StepViews {
 public:
  StepViews(Simulation& simulation, MeetingParts& others)
      : simulation_(simulation), others_(others), part_(simulation.part(&others)) {}

  const SimulationView& part() const { return part_; }
  /// On the first rank; the others' has no lists.
  const SimulationView& whole() {
    if (!whole_) whole_ = simulation_.whole(part_);
    return *whole_;
  }
  /// The same on all ranks, which costs each of them the memory of the whole.
  SimulationView everywhere() { return simulation_.whole(part_, true); }
  MeetingParts& others() { return others_; }

  /// Calls `f(view)` on all ranks with the part, if it `sees_parts`, else on the first with the whole. What fails on
  /// one fails on all.
  template <class F>
  void show(bool sees_parts, F&& f) {
    if (!sees_parts) whole();
    others_.together([&] {
      if (sees_parts) f(part_);
      else if (others_.first()) f(*whole_);
    });
  }

 private:
  Simulation& simulation_;
  MeetingParts& others_;
  SimulationView part_;
  std::optional<SimulationView> whole_;
};

}  // namespace breccia
