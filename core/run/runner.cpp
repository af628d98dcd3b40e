// SPDX-License-Identifier: BSD-3-Clause
#include "run/runner.hpp"

#include <fmt/format.h>

#include <chrono>

#include "archive/curves_file.hpp"
#include "breccia/contact_law.hpp"
#include "breccia/output.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/axial_config.hpp"
#include "breccia/sdk_abi.hpp"
#include "breccia/utf8.hpp"
#include "config/writer.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "engine/specimen.hpp"
#include "plugin/out_of_memory.hpp"
#include "results/curve_table.hpp"
#include "results/results_folder.hpp"
#include "results/summary_table.hpp"
#include "run/branch.hpp"
#include "run/checkpoints.hpp"
#include "run/checks.hpp"
#include "run/columns.hpp"
#include "run/energy_check.hpp"
#include "run/environment.hpp"
#include "run/frames.hpp"
#include "run/listed.hpp"
#include "run/loading.hpp"
#include "run/packing_cache.hpp"
#include "run/provenance.hpp"
#include "run/render.hpp"
#include "run/run_archive.hpp"
#include "run/run_summary.hpp"
#include "run/scatter_summary.hpp"
#include "run/threads.hpp"
#include "run/warning_log.hpp"
#include "workflow/contact_laws.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Everything of one run; each step of `run_workflow` is a member.
class Run {
 public:
  Run(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options, RunMonitor& monitor)
      : w_(loaded.workflow),
        config_(loaded.config),
        places_(loaded.places),
        doubts_(loaded.warnings),
        registry_(registry),
        options_(options),
        link_(options.link),
        first_(!link_ || link_->first()),
        monitor_(monitor) {}

  RunOutcome operator()() {
    const auto start = Clock::now();
    refuse_without_threads(monitor_.threads());
    if (options_.resume) (*options_.resume->checkpoint)("warnings", monitor_);  // what was said is not said again
    for (const std::string& doubt : doubts_) monitor_.warn(doubt);
    places_.placing([&] {
      create_plugins();
      build();
    });
    if (first_) write_file(options_.folder / "resolved.yaml", about_.resolved);
    loop();
    finish();
    if (!first_) return {summary_.json(), interrupted_, failure_};
    refuse_if_gone();
    write_summary(seconds_since(start));  // whole before the pictures, which may take long or be interrupted
    const std::filesystem::path results =
        options_.whole ? options_.whole(interrupted_ || !failure_.empty()) : options_.folder;
    draw(results);
    add_to_summary(seconds_since(start));
    return {summary_.json(), interrupted_, failure_};
  }

 private:
  void create_plugins() {
    laws_.emplace(registry_, w_.contact_law, w_.material_list(), std::uint64_t(w_.seed));
    protocol_ = registry_.create<Protocol>(w_.protocol);
    std::vector<Listed<Output>> outputs;
    if (first_) {  // who measures and writes sees the specimen brought together, where it is brought to
      for (const PluginChoice& c : w_.postprocessors) posts_.emplace_back(c, registry_);
      for (const PluginChoice& c : w_.outputs) outputs.emplace_back(c, registry_);
    }
    frames_ = std::make_unique<Frames>(std::move(outputs), posts_);
  }

  void build() {
    const int dimension = int(w_.dimension);
    packing_ = obtain_packing(registry_, w_.packing, w_.packing_request(), options_.packing_cache, monitor_);
    monitor_.info(fmt::format("packing `{}`: {} particles{}", w_.packing.type, packing_.particles.position.size(),
                              packing_.from_cache ? " (kept from an earlier run)" : ""));
    memory_is_for(packing_.particles.position.size(), 0);
    for (const AskedGot& line : packing_.particles.report) monitor_.info(asked_got_text(line));
    if (options_.resume && first_)
      refuse_changes(options_.resume->about, provenance_of(w_, registry_, packing_.hash),
                     options_.accept_changed_plugins, monitor_);
    resolve();
    if (w_.from)
      branch_.emplace(Beginner{w_, places_, about_.resolved, config_["provenance"], packing_.particles, registry_,
                               options_.accept_changed_plugins},
                      monitor_);
    laws_->within([&] {
      EngineSettings settings = w_.engine_settings(monitor_.threads());
      settings.link = link_;
      simulation_ = std::make_unique<Simulation>(
          assemble(packing_.particles, w_.materials_of(packing_.particles), dimension, w_.thickness),
          laws_->interactions(), settings);
      bonding_ = simulation_->bond(w_.bonding.rule());
    });
    memory_is_for(simulation_->state().particles.size(), simulation_->state().bonds.size());
    monitor_.info(bonds_text(bonding_, simulation_->state().bonds.size()));
    const SimulationView view = simulation_->view();
    for (std::size_t l = 0; l < laws_->size(); ++l) {
      drawn_.push_back(drawn_parameters(laws_->named(l), view));
      for (const DrawnParameter& drawn : drawn_.back()) monitor_.info("  " + drawn.text());
    }
    check_specimen(view, packing_porosity(), w_.checks, monitor_);
    if (branch_ && !branch_->goes_on()) begin_on_specimen();
    laws_->within([&] {
      time_column_ =
          add_columns(simulation_->view(), *simulation_, *protocol_, protocol_id(), posts_, curves_, monitor_);
    });
    frames_->begin(options_.folder, monitor_);
    laws_->within([&] {
      simulation_->prepare();
      check_time_step(*simulation_, w_.checks, monitor_);
    });
    loading_checks_.emplace(w_.checks);
    if (!first_) return;
    checkpoints_.emplace(
        w_.checkpoints, options_.folder, curves_, [&](Archive& to) { return archive_run(to, parts()); }, monitor_);
    if (link_) checkpoints_->before = [this](bool wanted) { bring_together(wanted); };
    curves_.open(options_.folder / "curves.csv");
  }

  /// The full input, and what made the result: running it again gives the same bits.
  void resolve() {
    const Json provenance = provenance_of(w_, registry_, packing_.hash);
    if (!options_.resume)
      for (const std::string& change : changes_since(w_.provenance, provenance)) monitor_.warn(change);
    config_["provenance"] = provenance;
    if (!is_utf8(config_))
      monitor_.warn("the name of an input file is not UTF-8: resolved.yaml cannot state it and cannot be run again");
    about_ = {BRECCIA_VERSION,
              "# The full input of this run, defaults included; run it again for the same result.\n" +
                  write_yaml(config_, workflow_schema(), registry_),
              provenance.dump(-1, ' ', false, Json::error_handler_t::replace), BRECCIA_SDK_ABI};
  }

  void begin_on_specimen() {
    monitor_.info(branch_->text());
    const Archive::Group engine(branch_->archive(), "engine");
    laws_->within([&] { simulation_->take_specimen(branch_->archive()); });
  }

  RunProgress progress() const { return {simulation_->time(), simulation_->state().step}; }

  void loop() {
    Simulation& sim = *simulation_;
    if (w_.engine.added_mass > 0) monitor_.info(added_mass_text(sim));
    monitor_.info(step_text(sim, w_.engine.time_step, monitor_.threads()));
    Loading& loading = loading_.emplace(sim, *laws_, *protocol_, protocol_id(),
                                        Sampling{std::uint64_t(w_.sampling.every_steps), w_.sampling.load_change});
    if (options_.resume) go_on();
    else if (branch_) enter_branch();
    branch_.reset();  // with the file
    first_step_ = sim.state().step;
    if (first_) checkpoints_->start_from(progress());
    try {
      for (;;) {
        const bool cancelled = link_ ? link_->any(monitor_.cancelled()) : monitor_.cancelled();
        if (first_) checkpoints_->at(progress(), cancelled || (w_.checkpoints.at_end && loading.ends()));
        else bring_together(false);
        auto start = Clock::now();
        in_row_ = false;
        const LoadingStep now = loading.step(cancelled);
        loop_seconds_ += seconds_since(start);
        if (now.row) {
          in_row_ = true;
          refuse_if_gone();
          together([&] { laws_->within([&] { sample(now.begins); }); });
          if (now.ends || !failure_.empty()) {
            interrupted_ = cancelled && failure_.empty();
            break;
          }
        }
        start = Clock::now();
        laws_->within([&] { sim.advance(); });
        loop_seconds_ += seconds_since(start);
      }
      loading.warn_of_missed_peak(monitor_);
      loading_checks_->finish(sim, loading.peak(), monitor_);
    } catch (const FolderGone&) { throw; } catch (const PluginFault& e) {
      if (alone()) throw;
      fail(e);
    } catch (const UserError& e) {
      if (!measured_ || alone()) throw;  // nothing is lost; or the others cannot go on
      fail(e);
    } catch (const std::bad_alloc&) {
      if (!measured_ || alone()) throw;
      fail(UserError(out_of_memory()));
      intact_ = false;
    }
    refuse_if_gone();
    viewable_ = intact_ && complete_step();
    if (viewable_) attempt([&] { frames_->at(sim.view(), true); });
    attempt([&] { frames_->finish(); });
    if (!first_) return;
    curves_.close();
    if (w_.curves.hdf5) attempt([&] { write_curves_hdf5(options_.folder / "curves.h5", curves_); });
  }

  RunParts parts() {
    return {about_, monitor_, *simulation_, *loading_,     *protocol_,      protocol_id(),
            posts_, *frames_, curves_,      energy_check_, *loading_checks_};
  }

  void enter_branch() {
    if (branch_->goes_on()) monitor_.info(branch_->text());
    for (const std::string& d : branch_->differences()) monitor_.info("  " + d);
    if (!branch_->goes_on()) return;
    read_branch(branch_->archive(), parts(), first_ && branch_->measured());
    if (!branch_->needs_adapting()) return;
    laws_->within([&] { simulation_->adapt(); });
    monitor_.info(step_text(*simulation_, w_.engine.time_step, monitor_.threads()));
  }

  void go_on() {
    if (first_) read_run(*options_.resume->checkpoint, parts());
    else read_branch(*options_.resume->checkpoint, parts(), false);
    measured_ = first_ ? curves_.rows() > 0 : simulation_->loading_started();
    monitor_.info(fmt::format("goes on from {}: step {}, {:.4g} s, {} rows of curves",
                              options_.resume->checkpoint->file().string(), simulation_->state().step,
                              simulation_->time(), curves_.rows()));
    options_.resume->checkpoint.reset();
  }

  /// What was measured so far is kept, and says so.
  void fail(const UserError& e) {
    if (failure_ == e.what()) return;  // it is no other one for being met again
    if (failure_.empty()) failure_ = e.what();
    monitor_.warn(e.what());
  }
  template <class F>
  void attempt(F&& f) {
    try {
      f();
    } catch (const UserError& e) { fail(e); }
  }

  /// Whether there is a state to be viewed; after a plugin's fault in the middle of a step it takes one more, unless
  /// the law has failed.
  bool complete_step() {
    if (in_row_ && !laws_->has_failed()) return true;
    try {
      laws_->within([&] {
        if (laws_->has_failed()) return;
        if (simulation_->forces_known()) simulation_->advance();
        simulation_->forces();
      });
    } catch (const UserError& e) { fail(e); }
    return !laws_->has_failed() && simulation_->forces_known();
  }

  void sample(bool begins) {
    Simulation& sim = *simulation_;
    SimulationView view;
    laws_->within([&] { view = sim.view(); });  // a row without the law's energy would be wrong
    loading_checks_->sample(sim, calling(protocol_id(), "telling its load", [&] { return protocol_->load(); }),
                            monitor_);
    if (sim.loading_started()) {
      if (link_ ? link_->as_first_says(!energy_check_) : !energy_check_) begin_energy_check();
      measured_ = true;
      curves_.set(time_column_, sim.time());
      if (first_) calling(protocol_id(), "measuring", [&] { protocol_->sample(view, curves_); });
      if (begins)
        for (auto& p : posts_) p.call("beginning to measure", [&](Postprocessor& q) { q.start_of_loading(view); });
      try {
        if (first_) energy_check_->sample(view.energy, view.step, monitor_);
      } catch (const UserError& e) { fail(e); }
      for (auto& p : posts_) p.call("measuring", [&](Postprocessor& q) { q.sample(view, curves_); });
      if (first_) curves_.end_row();
      frames_->at(view, begins);
    }
    calling(protocol_id(), "telling how far it is", [&] {
      monitor_.status({protocol_->share_done(), view.step, view.time, sim.broken_bonds(), protocol_->status()});
    });
  }

  void begin_energy_check() {
    const EnergyLimits limits = energy_limits();
    if (first_) energy_check_.emplace(limits, w_.contact_law.names("` and `"));
  }

  EnergyLimits energy_limits() {
    constexpr double strain = strain_of_touch;
    const SpecimenShape& specimen = simulation_->state().specimen;
    return {w_.engine.energy_error_warning, w_.engine.energy_error_limit,
            0.5 * simulation_->bond_stiffness().modulus * specimen.volume * double(w_.dimension) * strain * strain};
  }

  /// Before a checkpoint, on all ranks as the first says.
  void bring_together(bool wanted) {
    if (link_->as_first_says(wanted)) simulation_->gather();
  }

  /// What only the first rank may fail at ends the loop of all of them.
  template <class F>
  void together(F&& f) {
    std::exception_ptr failed;
    try {
      f();
    } catch (...) { failed = std::current_exception(); }
    double thrown_said[2] = {failed ? 1.0 : 0.0, failure_.empty() ? 0.0 : 1.0};
    if (link_) link_->largest(thrown_said);
    if (failed) std::rethrow_exception(failed);
    constexpr const char* other = "another rank could not go on";
    if (thrown_said[0] > 0) throw UserError(other);
    if (thrown_said[1] > 0 && failure_.empty()) failure_ = other;
  }
  /// Whether other ranks do not end as this one does; they cannot be asked to any more.
  bool alone() const { return link_ && !link_->all_end(); }

  void finish() {
    simulation_->gather();
    sum_up_engine(summary_, w_, *simulation_, bonding_, packing_porosity(),
                  {interrupted_, monitor_.threads(), first_step_, loop_seconds_});
    attempt([&] { sum_up_laws(summary_, *laws_, drawn_, simulation_->state()); });
    if (viewable_) {
      const SimulationView view = simulation_->view();
      if (first_) finish_plugins(view);
    }
    if (!first_) return;
    tell_of_gathering();
    sum_up_packing(summary_, packing_.particles.report);
    summary_.set("reference", w_.reference);
    summary_.set("environment", environment());
  }

  /// Who asks for the whole specimen makes all ranks wait until it is brought together.
  void tell_of_gathering() {
    const double seconds = simulation_->seconds_gathering();
    if (link_ && seconds > 0.05 * loop_seconds_)
      monitor_.info(
          fmt::format("bringing the specimen together for measurements, files and checkpoints took {:.1f} s, "
                      "that is {:.0f} % of the time of all steps: sample less often",
                      seconds, 100 * seconds / loop_seconds_));
  }

  /// Those that have failed have nothing to say.
  void finish_plugins(const SimulationView& view) {
    if (energy_check_) energy_check_->finish(view.energy, view.step, monitor_);
    SummaryTable::Section protocol(summary_, w_.protocol.type);
    attempt([&] { calling(protocol_id(), "summing up", [&] { protocol_->finish(view, curves_, protocol); }); });
    for (auto& p : posts_) {
      if (p.has_failed()) continue;
      NamedSummary section(summary_, p);
      const NamedCurves curves(curves_, p.prefix());
      attempt([&] { p.call("summing up", [&](Postprocessor& q) { q.finish(view, curves, section); }); });
    }
  }

  void refuse_if_gone() const {
    if (options_.refuse_if_gone) options_.refuse_if_gone();
  }

  /// What came after the results were whole. They are so without it.
  void add_to_summary(double wall_seconds) {
    refuse_if_gone();
    try {
      write_summary(wall_seconds);
    } catch (const UserError& e) {
      monitor_.warn(
          fmt::format("the results are whole, but their summary does not have the last warnings: {}", e.what()));
    }
  }

  PluginId protocol_id() const { return {Protocol::kind, w_.protocol.type}; }

  /// The summary as it stands; what grows until the end of the run is set anew.
  void write_summary(double wall_seconds) {
    summary_.update({"wall_time", "s"}, wall_seconds);
    summary_.update("warnings", monitor_.warnings());
    summary_.write(options_.folder);
  }

  /// Of the container when the packing had one, else of the specimen as measured.
  double packing_porosity() const {
    const double container = packing_.particles.container_volume;
    if (container <= 0) return simulation_->porosity();
    return 1 - solid_volume(packing_.particles.radius, w_.space()) / container;
  }

  /// Pictures of the results in that folder. Nothing that happens here loses the run.
  void draw(const std::filesystem::path& results) {
    if (w_.renderers.empty()) return;
    try {
      for (const auto& file : render_all(w_.renderers, registry_, {results, options_.folder}, monitor_))
        monitor_.info("picture " + file.filename().string());
    } catch (const Cancelled&) {
      monitor_.warn("stopped on request before all pictures were drawn: `breccia render` draws them");
      interrupted_ = true;
    }
  }

  const Workflow& w_;
  Json config_;
  const Places& places_;
  const std::vector<std::string>& doubts_;
  const Registry& registry_;
  const RunOptions& options_;
  RankLink* const link_;
  const bool first_;       ///< of the ranks, if there are several
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

}  // namespace

RunOutcome run_workflow(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options,
                        RunMonitor& monitor) {
  return Run(loaded, registry, options, monitor)();
}

}  // namespace breccia
