// SPDX-License-Identifier: BSD-3-Clause
// The steps of a run and the rows of its curves.
#include <fmt/format.h>

#include "archive/curves_file.hpp"
#include "breccia/protocol_tools/axial_config.hpp"
#include "plugin/out_of_memory.hpp"
#include "results/results_folder.hpp"
#include "run/one_run.hpp"
#include "run/run_summary.hpp"

namespace breccia {

void OneRun::loop() {
  Simulation& sim = *simulation_;
  if (w_.engine.added_mass > 0) monitor_.info(added_mass_text(sim));
  monitor_.info(step_text(sim, w_.engine.time_step, monitor_.threads()));
  Loading& loading = loading_.emplace(sim, *laws_, *protocol_, protocol_id(),
                                      Sampling{std::uint64_t(w_.sampling.every_steps), w_.sampling.load_change});
  if (options_.resume) go_on();
  else if (branch_) enter_branch();
  branch_.reset();  // with the file
  first_step_ = sim.state().step;
  checkpoints_->start_from(progress());
  try {
    for (;;) {
      const bool cancelled = stop_or_checkpoint(w_.checkpoints.at_end && loading.ends());
      auto start = std::chrono::steady_clock::now();
      in_row_ = false;
      const LoadingStep now = loading.step(cancelled);
      loop_seconds_ += seconds_since(start);
      if (now.row) {
        in_row_ = true;
        refuse_if_gone();
        ranks_.together([&] { laws_->in_row([&] { sample(now.begins); }); }, failure_);
        if (now.ends || !failure_.empty()) {
          interrupted_ = cancelled && failure_.empty();
          break;
        }
      }
      start = std::chrono::steady_clock::now();
      laws_->in_step([&] { sim.advance(); });
      loop_seconds_ += seconds_since(start);
    }
    loading.warn_of_missed_peak(monitor_);
    loading_checks_->finish(sim, loading.peak(), monitor_);
  } catch (const FolderGone&) { throw; } catch (const PluginFault& e) {
    if (ranks_.alone()) throw;
    fail(e);
  } catch (const UserError& e) {
    if (!measured_ || ranks_.alone()) throw;  // nothing is lost; or the others cannot go on
    fail(e);
  } catch (const std::bad_alloc&) {
    if (!measured_ || ranks_.alone()) throw;
    fail(UserError(out_of_memory()));
    intact_ = false;
  }
  refuse_if_gone();
  viewable_ = intact_ && complete_step();
  if (viewable_)
    attempt([&] {
      StepViews views(sim, others_);
      frames_->at(views, true);
    });
  attempt([&] { frames_->finish(others_); });
  if (!ranks_.first()) return;
  curves_.close();
  if (w_.curves.hdf5) attempt([&] { write_curves_hdf5(options_.folder / "curves.h5", curves_); });
}

/// Before each step: whether anybody is asked to stop, whether the first rank's checkpoint is due, which all write, and
/// whether a law has failed on one of them. `last`: the test is over.
bool OneRun::stop_or_checkpoint(bool last) {
  double asked_due[3] = {monitor_.cancelled() ? 1.0 : 0.0, 0, laws_->has_failed() ? 1.0 : 0.0};
  if (ranks_.first()) asked_due[1] = checkpoints_->due(progress(), last || asked_due[0] > 0) ? 1 : 0;
  ranks_.largest(asked_due);
  if (asked_due[2] > 0) laws_->tell();
  const bool cancelled = asked_due[0] > 0;
  bool due = asked_due[1] > 0;
  if (cancelled && !due) due = ranks_.as_first_says(ranks_.first() && checkpoints_->due(progress(), true));
  if (due) checkpoints_->write(progress());
  return cancelled;
}

void OneRun::enter_branch() {
  if (branch_->goes_on()) monitor_.info(branch_->text());
  for (const std::string& d : branch_->differences()) monitor_.info("  " + d);
  if (!branch_->goes_on()) return;
  read_branch(branch_->archive(), parts(), branch_->measured());
  if (!branch_->needs_adapting()) return;
  laws_->within([&] { simulation_->adapt(); });
  monitor_.info(step_text(*simulation_, w_.engine.time_step, monitor_.threads()));
}

void OneRun::go_on() {
  read_run(*options_.resume->checkpoint, parts());
  measured_ = ranks_.first() ? curves_.rows() > 0 : simulation_->loading_started();
  monitor_.info(fmt::format("goes on from {}: step {}, {:.4g} s, {} rows of curves",
                            options_.resume->checkpoint->file().string(), simulation_->state().step,
                            simulation_->time(), curves_.rows()));
  options_.resume->checkpoint.reset();
}

/// Whether there is a state to be viewed; after a plugin's fault in the middle of a step it takes one more, unless
/// the law has failed.
bool OneRun::complete_step() {
  const auto law_has_failed = [&] { return any_rank(ranks_.link(), laws_->has_failed()); };
  bool failed = law_has_failed();
  if (in_row_ && !failed) return true;
  try {
    laws_->within([&] {
      if (failed) return;
      if (simulation_->forces_known()) simulation_->advance();
      simulation_->forces();
    });
  } catch (const UserError& e) { fail(e); }
  failed = law_has_failed();
  return !failed && simulation_->forces_known();
}

void OneRun::sample(bool begins) {
  Simulation& sim = *simulation_;
  std::optional<StepViews> views;
  laws_->within([&] { views.emplace(sim, others_); });  // a row without the law's energy would be wrong
  const SimulationView& part = views->part();
  loading_checks_->sample(sim, part, calling(protocol_id(), "telling its load", [&] { return protocol_->load(); }),
                          monitor_);
  if (sim.loading_started()) {
    if (ranks_.as_first_says(!energy_check_)) begin_energy_check();
    measured_ = true;
    curves_.set(time_column_, sim.time());
    views->show(protocol_->sees_parts(), [&](const SimulationView& view) {
      calling(protocol_id(), "measuring", [&] { protocol_->sample(view, curves_); });
    });
    if (begins)
      for (auto& p : posts_)
        p.show(*views, "beginning to measure",
               [&](Postprocessor& q, const SimulationView& view) { q.start_of_loading(view); });
    try {
      if (ranks_.first()) energy_check_->sample(part.energy, part.step, monitor_);
    } catch (const UserError& e) { fail(e); }
    for (auto& p : posts_)
      p.show(*views, "measuring", [&](Postprocessor& q, const SimulationView& view) { q.sample(view, curves_); });
    others_.together([&] {
      if (ranks_.first()) curves_.end_row();
    });
    frames_->at(*views, begins);
  }
  calling(protocol_id(), "telling how far it is", [&] {
    monitor_.status({protocol_->share_done(), part.step, part.time, sim.broken_bonds(), protocol_->status()});
  });
}

void OneRun::begin_energy_check() {
  const EnergyLimits limits = energy_limits();
  if (ranks_.first()) energy_check_.emplace(limits, w_.contact_law.names("` and `"));
}

EnergyLimits OneRun::energy_limits() {
  constexpr double strain = strain_of_touch;
  const SpecimenShape& specimen = simulation_->state().specimen;
  return {w_.engine.energy_error_warning, w_.engine.energy_error_limit,
          0.5 * simulation_->bond_stiffness().modulus * specimen.volume * double(w_.dimension) * strain * strain};
}

}  // namespace breccia
