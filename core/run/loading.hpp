// SPDX-License-Identifier: BSD-3-Clause
/// A test under way, step by step: when the protocol decides, and which steps become rows of the curves.
#pragma once

#include "engine/simulation.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {

struct Sampling {
  std::uint64_t every_steps = 50;
  double load_change = 0.02;  ///< a row is added where the load has changed by this share of its largest; 0: none is
};

/// What a step was, after its forces and before its motion.
struct LoadingStep {
  bool row = false;     ///< measure now, it is a row of the curves (before loading begins: of none)
  bool begins = false;  ///< loading has just begun
  bool ends = false;    ///< the test is over: the last row
};

/// The protocol decides after every step; what is measured, and how often, has no part in it.
class Loading {
 public:
  Loading(Simulation& simulation, ContactLaws& laws, Protocol& protocol, const PluginId& id, const Sampling& sampling)
      : simulation_(simulation), laws_(laws), protocol_(protocol), id_(id), sampling_(sampling) {}

  /// Forces and decision of a step. `last`: it is the last one, whatever the protocol says.
  LoadingStep step(bool last = false);

  /// The protocol's largest load so far.
  double peak() const { return peak_; }
  /// Whatever is read off the curves is read off their rows: when these have missed the peak.
  void warn_of_missed_peak(Host& host) const;
  bool ends() const { return end_; }  ///< the step to come is the last
  void archive(Archive& archive);

 private:
  bool load_calls_for_row() const;

  Simulation& simulation_;
  ContactLaws& laws_;
  Protocol& protocol_;
  PluginId id_;  ///< of the protocol
  Sampling sampling_;
  bool look_ = true, row_ = true, end_ = false;  ///< of the step to come
  double load_ = 0, load_of_row_ = 0, peak_ = 0, peak_of_rows_ = 0;
  double load_scale_ = 0;
  std::uint64_t step_of_row_ = 0;
};

}  // namespace breccia
