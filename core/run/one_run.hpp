// SPDX-License-Identifier: BSD-3-Clause
/// Everything of one run. Its stages stand in files of their own: what it is made of (`runner.cpp`), its steps and rows
/// (`run_loop.cpp`), what is left of it (`run_end.cpp`).
#pragma once

#include <chrono>

#include "breccia/output.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "engine/simulation.hpp"
#include "results/curve_table.hpp"
#include "results/summary_table.hpp"
#include "run/branch.hpp"
#include "run/checkpoints.hpp"
#include "run/checks.hpp"
#include "run/energy_check.hpp"
#include "run/frames.hpp"
#include "run/listed.hpp"
#include "run/loading.hpp"
#include "run/packing_cache.hpp"
#include "run/run_archive.hpp"
#include "run/run_ranks.hpp"
#include "run/runner.hpp"
#include "run/scatter_summary.hpp"
#include "run/step_views.hpp"
#include "run/warning_log.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class OneRun {
 public:
  OneRun(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options, RunMonitor& monitor)
      : w_(loaded.workflow),
        config_(loaded.config),
        places_(loaded.places),
        doubts_(loaded.warnings),
        registry_(registry),
        options_(options),
        ranks_(options.link),
        others_(options.link),
        monitor_(monitor) {}

  RunOutcome operator()();

 private:
  // runner.cpp
  void create_plugins();
  void build();
  void forget_packing();
  void resolve();
  void begin_on_specimen();

  // run_loop.cpp
  void loop();
  bool stop_or_checkpoint(bool last);
  void enter_branch();
  void go_on();
  bool complete_step();
  void sample(bool begins);
  void begin_energy_check();
  EnergyLimits energy_limits();
  RunProgress progress() const { return {simulation_->time(), simulation_->state().step}; }
  RunParts parts() {
    return {about_, monitor_, *simulation_, *loading_,     *protocol_,       protocol_id(),
            posts_, *frames_, curves_,      energy_check_, *loading_checks_, ranks_.first()};
  }

  // run_end.cpp
  void finish();
  void tell_of_ranks();
  const Curves& curves_of_all(CurveTable& told);
  void finish_plugins(StepViews& views);
  void write_summary(double wall_seconds);
  void add_to_summary(double wall_seconds);
  void draw(const std::filesystem::path& results);

  void fail(const UserError& e);
  template <class F>
  void attempt(F&& f) {
    try {
      f();
    } catch (const UserError& e) { fail(e); }
  }
  void refuse_if_gone() const {
    if (options_.refuse_if_gone) options_.refuse_if_gone();
  }
  PluginId protocol_id() const { return {Protocol::kind, w_.protocol.type}; }
  double packing_porosity() const;

  const Workflow& w_;
  Json config_;
  const Places& places_;
  const std::vector<std::string>& doubts_;
  const Registry& registry_;
  const RunOptions& options_;
  const RunRanks ranks_;
  MeetingParts others_;    ///< of plugins that see parts
  bool measured_ = false;  ///< there are rows
  RunLog monitor_;
  std::optional<ContactLaws> laws_;
  std::unique_ptr<Protocol> protocol_;
  std::vector<Listed<Postprocessor>> posts_;
  std::unique_ptr<Frames> frames_;
  PackingOutcome packing_;
  BondingResult bonding_;
  std::vector<std::vector<DrawnParameter>> drawn_;  ///< law by law
  std::unique_ptr<Simulation> simulation_;
  CurveTable curves_;
  SummaryTable summary_;
  std::optional<EnergyCheck> energy_check_;
  std::optional<LoadingChecks> loading_checks_;
  std::optional<Loading> loading_;
  CheckpointAbout about_;
  std::optional<Branch> branch_;
  std::optional<Checkpoints> checkpoints_;
  std::size_t time_column_ = 0;
  double loop_seconds_ = 0;
  std::uint64_t first_step_ = 0;  ///< of this process: 0 unless the run went on
  bool interrupted_ = false;
  bool in_row_ = false, viewable_ = true;  ///< the present step is a row; there is a state to be viewed
  bool intact_ = true;                     ///< nothing was interrupted while it changed the state
  std::string failure_;
};

}  // namespace breccia
