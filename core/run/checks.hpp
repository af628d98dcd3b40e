// SPDX-License-Identifier: BSD-3-Clause
/// What is almost surely a mistake in the input, though it can be computed.
#pragma once

#include "breccia/services.hpp"
#include "breccia/views.hpp"
#include "engine/simulation.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

/// Looks at the bonded specimen before the first step and warns of: particles with more volume than the specimen
/// (diameters read as radii), deep overlaps, bonds across wide gaps, particles without a bond, and such particles away
/// from the rest, by which the specimen would be measured. Of a specimen in parts all ranks call it together.
void check_specimen(const SimulationView& view, double porosity, const ChecksConfig& limits, Host& host);

/// Warns of one particle (or a few) that makes the time step of all others much shorter; after `prepare()`.
void check_time_step(Simulation& simulation, const ChecksConfig& limits, Host& host);

/// A row of the curves: the protocol's load and the unbalanced force ratio.
struct LoadedRow {
  double load, unbalanced;
};

/// The largest unbalanced force ratio between 10 and 90 % of the peak while the load rises. What follows a drop, when
/// some bonds have failed before the peak, is the motion that this sets free and no sign of too fast a test.
double unbalanced_on_the_rise(const std::vector<LoadedRow>& rows, double peak);

/// What shows only while the specimen is loaded; sees every row, and warns of each kind once.
class LoadingChecks {
 public:
  explicit LoadingChecks(const ChecksConfig& limits) : limits_(limits) {}

  /// After the forces of a step that may be viewed, of which `part` shows what this rank has; all ranks call it
  /// together. `load`: the protocol's.
  void sample(Simulation& simulation, const SimulationView& part, double load, Host& host);
  /// `peak`: the largest load of all steps. All ranks call it together.
  void finish(const Simulation& simulation, double peak, Host& host) const;
  void archive(Archive& archive);

 private:
  void look_for_speed(Simulation& simulation, Host& host);
  void look_for_overlaps(const SimulationView& part);

  ChecksConfig limits_;
  std::vector<LoadedRow> rows_;
  std::vector<double> wall_overlap_;          ///< deepest of each wall, over the particle's radius
  double pair_overlap_ = 0, pair_mean_ = 0;   ///< deepest over the sum of the radii, and the mean in that row
  double wave_speed_ = -1, walls_speed_ = 0;  ///< [m/s]; below zero: not known yet
  bool fast_ = false;
};

}  // namespace breccia
