// SPDX-License-Identifier: BSD-3-Clause
#include "run/runner.hpp"

#include <fmt/format.h>

#include <chrono>

#include "breccia/contact_law.hpp"
#include "breccia/output.hpp"
#include "breccia/postprocessor.hpp"
#include "breccia/protocol.hpp"
#include "breccia/utf8.hpp"
#include "config/writer.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "engine/specimen.hpp"
#include "output/curve_table.hpp"
#include "output/summary_table.hpp"
#include "run/checks.hpp"
#include "run/contention.hpp"
#include "run/energy_check.hpp"
#include "run/frames.hpp"
#include "run/loading.hpp"
#include "run/packing_cache.hpp"
#include "run/render.hpp"
#include "run/warning_log.hpp"

namespace breccia {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class RunLog final : public WarningLog<RunMonitor> {
 public:
  using WarningLog::WarningLog;
  void status(const RunStatus& status) override { to_.status(status); }
};

/// Everything of one run; each step of `run_workflow` is a member.
class Run {
 public:
  Run(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options, RunMonitor& monitor)
      : w_(loaded.workflow), config_(loaded.config), registry_(registry), options_(options), monitor_(monitor) {}

  RunOutcome operator()() {
    const auto start = Clock::now();
    create_plugins();
    build();
    write_resolved();
    loop();
    finish();
    write_summary(seconds_since(start));  // whole before the pictures, which may take long or be interrupted
    const std::filesystem::path results =
        options_.whole ? options_.whole(interrupted_ || !failure_.empty()) : options_.folder;
    draw(results);
    write_summary(seconds_since(start));
    return {summary_.json(), interrupted_, failure_};
  }

 private:
  void create_plugins() {
    law_ = registry_.create<ContactLaw>(w_.contact_law);
    protocol_ = registry_.create<Protocol>(w_.protocol);
    std::vector<std::unique_ptr<Output>> outputs;
    for (const PluginChoice& c : w_.postprocessors) posts_.push_back(registry_.create<Postprocessor>(c));
    for (const PluginChoice& c : w_.outputs) outputs.push_back(registry_.create<Output>(c));
    frames_ = std::make_unique<Frames>(std::move(outputs), posts_);
  }

  void build() {
    const int dimension = int(w_.dimension);
    packing_ = obtain_packing(registry_, w_.packing, {dimension, w_.thickness, std::uint64_t(w_.seed)},
                              options_.packing_cache, monitor_);
    report_packing();
    EngineSettings settings;
    settings.damping = {w_.damping.translational, w_.damping.rotational};
    settings.safety = w_.engine.time_step_safety;
    settings.skin = w_.engine.skin;
    settings.threads = monitor_.threads();
    settings.law = w_.contact_law.type;
    simulation_ = std::make_unique<Simulation>(
        assemble(packing_.particles, {w_.material.density}, dimension, w_.thickness), *law_, settings);
    bonding_ = simulation_->bond(w_.bonding.rule());
    const bool relative = bonding_.measure == GapMeasure::relative;
    monitor_.info(fmt::format(
        "{} bonds: coordination number {:.4f}, {}", simulation_->state().bonds.size(), bonding_.coordination_number,
        relative ? fmt::format("tolerance {:.4f}", bonding_.limit) : fmt::format("gap {:.4g} m", bonding_.limit)));
    time_column_ = curves_.add({"time", "s", "since the first step"});
    const SimulationView view = simulation_->view();
    check_specimen(view, packing_porosity(), w_.checks, monitor_);
    protocol_->setup(view, *simulation_, curves_, monitor_);
    for (auto& p : posts_) p->begin(view, curves_, monitor_);
    for (auto& p : posts_)
      for (const std::string& name : p->needed_curves()) (void)curves_.column(name);
    frames_->begin(options_.folder, monitor_);
    simulation_->prepare();
    check_time_step(*simulation_, w_.checks, monitor_);
    loading_checks_.emplace(w_.checks);
    curves_.open(options_.folder / "curves.csv");
  }

  void report_packing() {
    monitor_.info(fmt::format("packing `{}`: {} particles{}", w_.packing.type, packing_.particles.position.size(),
                              packing_.from_cache ? " (kept from an earlier run)" : ""));
    for (const AskedGot& line : packing_.particles.report) {
      const std::string unit = line.unit == "1" ? "" : " " + line.unit;
      monitor_.info(fmt::format("  {:<36} {:>14}   got {:.6g}{}", line.name,
                                line.asked ? fmt::format("asked {:.6g}", *line.asked) : "", line.got, unit));
    }
  }

  /// The full input, and what made the result: running it again gives the same bits.
  void write_resolved() {
    Json provenance = {{"breccia", BRECCIA_VERSION}, {"packing_content", packing_.hash}};
    const auto add = [&](const char* kind, const std::string& name) {
      const PluginInfo& info = registry_.info(kind, name);
      provenance["plugins"][std::string(kind) + "/" + name] = info.version + " " + info.sha256;
    };
    add("packing", w_.packing.type);
    add("contact_law", w_.contact_law.type);
    add("protocol", w_.protocol.type);
    for (const PluginChoice& c : w_.postprocessors) add("postprocessor", c.type);
    for (const PluginChoice& c : w_.outputs) add("output", c.type);
    for (const PluginChoice& c : w_.renderers) add("renderer", c.type);
    warn_of_changes(provenance);
    config_["provenance"] = provenance;
    if (!is_utf8(config_))
      monitor_.warn("the name of an input file is not UTF-8: resolved.yaml cannot state it and cannot be run again");
    write_file(options_.folder / "resolved.yaml",
               "# The full input of this run, defaults included; run it again for the same result.\n" +
                   write_yaml(config_, workflow_schema(), registry_));
  }

  void warn_of_changes(const Json& now) {
    const Json& then = w_.provenance;
    if (then.contains("packing_content") && then["packing_content"] != now["packing_content"])
      monitor_.warn("the packing is not the one this resolved workflow was made with: results will differ");
    if (!then.contains("plugins") || !then["plugins"].is_object()) return;
    for (const auto& [name, made_with] : then["plugins"].items())
      if (now["plugins"].contains(name) && now["plugins"][name] != made_with)
        monitor_.warn("plugin " + name + " has changed since this resolved workflow was written: results may differ");
  }

  void loop() {
    Simulation& sim = *simulation_;
    monitor_.info(fmt::format("time step {:.4g} s ({} of the critical), {} pairs, {} thread{}", sim.time_step(),
                              w_.engine.time_step_safety, sim.state().pairs.size(), monitor_.threads(),
                              monitor_.threads() == 1 ? "" : "s"));
    Contention contention(monitor_.threads());
    Loading loading(sim, *protocol_, {std::uint64_t(w_.sampling.every_steps), w_.sampling.load_change});
    for (;;) {
      auto start = Clock::now();
      const bool cancelled = monitor_.cancelled();
      const LoadingStep now = loading.step(cancelled);
      loop_seconds_ += seconds_since(start);
      if (now.row) {
        if (contention.noticed())
          monitor_.warn(
              "other programs use this run's cores too, and threads that wait for each other make it many times "
              "slower: "
              "stop it and start it with fewer --threads (the results do not depend on it)");
        sample(now.begins);
        if (now.ends || !failure_.empty()) {
          interrupted_ = cancelled && failure_.empty();
          break;
        }
      }
      start = Clock::now();
      sim.advance();
      loop_seconds_ += seconds_since(start);
    }
    warn_of_missed_peak(loading);
    loading_checks_->finish(sim, loading.peak(), monitor_);
    frames_->at(sim.view(), true);
    frames_->finish();
    curves_.close();
  }

  void sample(bool begins) {
    Simulation& sim = *simulation_;
    loading_checks_->sample(sim, protocol_->load(), monitor_);
    const SimulationView view = sim.view();
    if (sim.loading_started()) {
      curves_.set(time_column_, sim.time());
      protocol_->sample(view, curves_);
      if (begins)
        for (auto& p : posts_) p->start_of_loading(view);
      if (!energy_check_) energy_check_.emplace(energy_limits(), w_.contact_law.type);
      try {
        energy_check_->sample(view.energy, view.step, monitor_);
      } catch (const UserError& e) {  // what was measured so far is kept, and says so
        failure_ = e.what();
        monitor_.warn(failure_);
      }
      for (auto& p : posts_) p->sample(view, curves_);
      curves_.end_row();
      frames_->at(view, begins);
    }
    monitor_.status({protocol_->share_done(), view.step, view.time, sim.broken_bonds(), protocol_->status()});
  }

  /// Whatever is read off the curves is read off their rows.
  void warn_of_missed_peak(const Loading& loading) {
    constexpr double share = 0.01;
    if (loading.peak_of_rows() >= (1 - share) * loading.peak()) return;
    monitor_.warn(fmt::format(
        "the curves miss the peak: between their rows the load rose to {:.4g}, in them to {:.4g}. Strength and moduli "
        "read off them depend on sampling.every_steps: make it smaller{}",
        loading.peak(), loading.peak_of_rows(), w_.sampling.load_change > 0 ? "" : ", or set sampling.load_change"));
  }

  EnergyLimits energy_limits() {
    constexpr double strain = 1e-4;  // below, a platen that has just come to touch is all there is
    const SpecimenShape& specimen = simulation_->state().specimen;
    return {w_.engine.energy_error_warning, w_.engine.energy_error_limit,
            0.5 * simulation_->bond_stiffness().modulus * specimen.volume * double(w_.dimension) * strain * strain};
  }

  void finish() {
    Simulation& sim = *simulation_;
    const SimulationView view = sim.view();
    if (energy_check_) energy_check_->finish(view.energy, view.step, monitor_);
    const std::size_t n = view.particles.size(), bonds = view.bonds.size();
    summary_.set("workflow", w_.name);
    summary_.set("interrupted", interrupted_);
    summary_.set("seed", w_.seed);
    summary_.set("threads", monitor_.threads());
    summary_.set("steps", view.step);
    summary_.set("time_step_s", view.time_step);
    summary_.set("simulated_time_s", view.time);
    summary_.set("particles", n);
    summary_.set("bonds", bonds);
    summary_.set("porosity", packing_porosity());
    summary_.set("coordination_number", bonding_.coordination_number);
    summary_.set(bonding_.measure == GapMeasure::relative ? "bond_tolerance" : "bond_gap_m", bonding_.limit);
    summary_.set("ns_per_bond_step",
                 view.step && bonds ? Json(1e9 * loop_seconds_ / double(view.step) / double(bonds)) : Json());
    summary_.set("neighbour_list_rebuilds", sim.rebuilds());
    const Json derived = law_->derived();
    for (const auto& [key, value] : derived.items())
      SummaryTable::Section(summary_, w_.contact_law.type).own(key, value);
    SummaryTable::Section protocol(summary_, w_.protocol.type);
    protocol_->finish(view, curves_, protocol);
    for (std::size_t k = 0; k < posts_.size(); ++k) {
      SummaryTable::Section section(summary_, w_.postprocessors[k].type);
      posts_[k]->finish(view, curves_, section);
    }
    for (const AskedGot& line : packing_.particles.report) {
      Json entry = {{"unit", line.unit}, {"got", line.got}};
      if (line.asked) entry["asked"] = *line.asked;
      SummaryTable::Section(summary_, "packing").own(line.name, entry);
    }
    summary_.set("reference", w_.reference);
  }

  /// The summary as it stands; what grows until the end of the run is set anew.
  void write_summary(double wall_seconds) {
    summary_.update("wall_time_s", wall_seconds);
    summary_.update("warnings", monitor_.warnings());
    summary_.write(options_.folder);
  }

  /// Of the container when the packing had one, else of the specimen as measured.
  double packing_porosity() const {
    const double container = packing_.particles.container_volume;
    if (container <= 0) return simulation_->porosity();
    return 1 - solid_volume(packing_.particles.radius, int(w_.dimension), w_.thickness) / container;
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
  const Registry& registry_;
  const RunOptions& options_;
  RunLog monitor_;
  std::unique_ptr<ContactLaw> law_;
  std::unique_ptr<Protocol> protocol_;
  std::vector<std::unique_ptr<Postprocessor>> posts_;
  std::unique_ptr<Frames> frames_;
  PackingOutcome packing_;
  BondingResult bonding_;
  std::unique_ptr<Simulation> simulation_;
  CurveTable curves_;
  SummaryTable summary_;
  std::optional<EnergyCheck> energy_check_;
  std::optional<LoadingChecks> loading_checks_;
  std::size_t time_column_ = 0;
  double loop_seconds_ = 0;
  bool interrupted_ = false;
  std::string failure_;
};

}  // namespace

RunOutcome run_workflow(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options,
                        RunMonitor& monitor) {
  return Run(loaded, registry, options, monitor)();
}

}  // namespace breccia
