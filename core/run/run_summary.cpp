// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_summary.hpp"

#include <fmt/format.h>

namespace breccia {

void sum_up_engine(SummaryTable& summary, const Workflow& w, const Simulation& sim, const BondingResult& bonding,
                   double porosity, const ProcessOfRun& run) {
  const State& state = sim.state();
  const std::uint64_t steps = state.step - run.first_step;
  const std::size_t n = state.particles.size(), bonds = state.bonds.size();
  summary.set("workflow", w.name);
  summary.set("interrupted", run.interrupted);
  summary.set("seed", w.seed);
  summary.set("threads", run.threads);
  summary.set("steps", state.step);
  summary.set({"time_step", "s"}, state.time_step);
  summary.set("time_step_from", w.engine.time_step == TimeStep::spectral ? "spectral" : "bound");
  summary.set({"critical_time_step", "s"}, sim.critical_step());
  summary.set("time_step_over_bound", sim.step_over_bound());
  if (w.engine.time_step == TimeStep::spectral) summary.set("time_step_products", sim.mode_products());
  if (w.engine.added_mass > 0) {
    summary.set("added_mass_share", sim.added_mass().share);
    summary.set("added_mass_particles", sim.added_mass().particles);
    summary.set("added_mass_largest_factor", sim.added_mass().largest_factor);
  }
  summary.set({"simulated_time", "s"}, state.time);
  summary.set("particles", n);
  summary.set("bonds", bonds);
  summary.set("porosity", porosity);
  summary.set("coordination_number", bonding.coordination_number);
  summary.set(bonding.measure == GapMeasure::relative ? ResultName("bond_tolerance") : ResultName("bond_gap", "m"),
              bonding.limit);
  summary.set("ns_per_bond_step",
              steps && bonds ? Json(1e9 * run.loop_seconds / double(steps) / double(bonds)) : Json());
  summary.set("neighbour_list_rebuilds", sim.rebuilds());
}

std::string step_text(const Simulation& sim, TimeStep rule, int threads) {
  return fmt::format(
      "time step {:.4g} s ({:.3g} of the critical, {}), {} pairs, {} thread{}", sim.time_step(),
      sim.time_step() / sim.critical_step(),
      rule == TimeStep::spectral
          ? fmt::format("of the fastest mode: {:.2f} times the bound of single particles", sim.step_over_bound())
          : "the bound of single particles",
      sim.state().pairs.size(), threads, threads == 1 ? "" : "s");
}

std::string asked_got_text(const AskedGot& line) {
  const std::string unit = line.unit == "1" ? "" : " " + line.unit;
  return fmt::format("  {:<36} {:>14}   got {:.6g}{}", line.name,
                     line.asked ? fmt::format("asked {:.6g}", *line.asked) : "", line.got, unit);
}

}  // namespace breccia
