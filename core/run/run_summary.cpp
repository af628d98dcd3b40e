// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_summary.hpp"

#include <fmt/format.h>

namespace breccia {

void sum_up_engine(SummaryTable& summary, const Workflow& w, const Simulation& sim, const BondingResult& bonding,
                   double porosity, const ProcessOfRun& run) {
  const State& state = sim.state();
  const std::uint64_t steps = state.step - run.first_step;
  const std::size_t n = sim.all_particles(), bonds = sim.all_bonds();
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

void sum_up_laws(SummaryTable& summary, const ContactLaws& laws, const std::vector<std::vector<DrawnParameter>>& drawn,
                 const State& state) {
  for (std::size_t l = 0; l < laws.size(); ++l) {
    SummaryTable::Section section(summary, laws.name(l));
    for (auto& [name, value] : laws.law(l).derived()) section.own(name, std::move(value));
    Json scatter = Json::array();
    for (const DrawnParameter& one : drawn[l]) scatter.push_back(one.json());
    if (!scatter.empty()) section.own("scatter", scatter);
    if (laws.size() == 1) continue;  // of one law the ledger says the same
    const Dissipated& lost = state.dissipated[l];
    section.own({"friction", "J"}, lost.friction);
    section.own({"contact", "J"}, lost.contact);
    section.own({"fracture", "J"}, lost.fracture);
  }
}

void sum_up_packing(SummaryTable& summary, const std::vector<AskedGot>& report) {
  for (const AskedGot& line : report) {
    Json entry = {{"unit", line.unit}, {"got", line.got}};
    if (line.asked) entry["asked"] = *line.asked;
    SummaryTable::Section(summary, "packing").own(line.name, entry);
  }
}

std::string bonds_text(const BondingResult& bonding) {
  return fmt::format("{} bonds: coordination number {:.4f}, {}", bonding.bonds, bonding.coordination_number,
                     bonding.measure == GapMeasure::relative ? fmt::format("tolerance {:.4f}", bonding.limit)
                                                             : fmt::format("gap {:.4g} m", bonding.limit));
}

std::string added_mass_text(const Simulation& sim) {
  const AddedMass& added = sim.added_mass();
  return fmt::format("added mass: {:.4g} % of the total, to {} of {} particles, at most {:.4g} times their own",
                     100 * added.share, added.particles, sim.all_particles(), added.largest_factor);
}

std::string step_text(const Simulation& sim, TimeStep rule, int threads) {
  return fmt::format(
      "time step {:.4g} s ({:.3g} of the critical, {}), {} pairs, {} thread{}", sim.time_step(),
      sim.time_step() / sim.critical_step(),
      rule == TimeStep::spectral
          ? fmt::format("of the fastest mode: {:.2f} times the bound of single particles", sim.step_over_bound())
          : "the bound of single particles",
      sim.pairs(), threads, threads == 1 ? "" : "s");
}

std::string asked_got_text(const AskedGot& line) {
  const std::string unit = line.unit == "1" ? "" : " " + line.unit;
  return fmt::format("  {:<36} {:>14}   got {:.6g}{}", line.name,
                     line.asked ? fmt::format("asked {:.6g}", *line.asked) : "", line.got, unit);
}

}  // namespace breccia
