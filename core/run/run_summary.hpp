// SPDX-License-Identifier: BSD-3-Clause
/// What every run says of itself, whatever its plugins: in the summary, and on the way.
#pragma once

#include "engine/simulation.hpp"
#include "results/summary_table.hpp"
#include "run/scatter_summary.hpp"
#include "workflow/contact_laws.hpp"
#include "workflow/workflow.hpp"

namespace breccia {

/// What this process has done of the run; another may have done the rest before it.
struct ProcessOfRun {
  bool interrupted;
  int threads;
  std::uint64_t first_step;
  double loop_seconds;  ///< in the steps since then [s]
};

void sum_up_engine(SummaryTable& summary, const Workflow& w, const Simulation& sim, const BondingResult& bonding,
                   double porosity, const ProcessOfRun& run);

/// What each law has derived, what its bonds have drawn (`drawn`: law by law), and what it has dissipated.
void sum_up_laws(SummaryTable& summary, const ContactLaws& laws, const std::vector<std::vector<DrawnParameter>>& drawn,
                 const State& state);
void sum_up_packing(SummaryTable& summary, const std::vector<AskedGot>& report);

/// How many bonds there are, and by which rule.
std::string bonds_text(const BondingResult& bonding);
std::string added_mass_text(const Simulation& sim);
/// The time step and where it comes from, pairs and threads.
std::string step_text(const Simulation& sim, TimeStep rule, int threads);
/// A line of the packing's report.
std::string asked_got_text(const AskedGot& line);

}  // namespace breccia
