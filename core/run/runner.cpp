// SPDX-License-Identifier: BSD-3-Clause
// What a run is made of, and its order.
#include "run/runner.hpp"

#include <fmt/format.h>

#include "breccia/atomic_file.hpp"
#include "breccia/sdk_abi.hpp"
#include "breccia/utf8.hpp"
#include "config/writer.hpp"
#include "engine/assembly.hpp"
#include "plugin/out_of_memory.hpp"
#include "run/checks.hpp"
#include "run/columns.hpp"
#include "run/one_run.hpp"
#include "run/packing_parts.hpp"
#include "run/provenance.hpp"
#include "run/run_summary.hpp"
#include "run/threads.hpp"

namespace breccia {

RunOutcome OneRun::operator()() {
  const auto start = std::chrono::steady_clock::now();
  refuse_without_threads(monitor_.threads());
  if (options_.resume) (*options_.resume->checkpoint)("warnings", monitor_);  // what was said is not said again
  for (const std::string& doubt : doubts_) monitor_.warn(doubt);
  places_.placing([&] {
    create_plugins();
    build();
  });
  if (ranks_.first()) write_file(options_.folder / "resolved.yaml", about_.resolved);
  loop();
  finish();
  if (!ranks_.first()) return {summary_.json(), interrupted_, failure_};
  refuse_if_gone();
  write_summary(seconds_since(start));  // whole before the pictures, which may take long or be interrupted
  const std::filesystem::path results =
      options_.whole ? options_.whole(interrupted_ || !failure_.empty()) : options_.folder;
  draw(results);
  add_to_summary(seconds_since(start));
  return {summary_.json(), interrupted_, failure_};
}

void OneRun::create_plugins() {
  laws_.emplace(registry_, w_.contact_law, w_.material_list(), std::uint64_t(w_.seed));
  laws_->meet(others_);
  protocol_ = registry_.create<Protocol>(w_.protocol);
  std::vector<Listed<Output>> outputs;
  for (const PluginChoice& c : w_.postprocessors) posts_.emplace_back(c, registry_, ranks_.first());
  for (const PluginChoice& c : w_.outputs) outputs.emplace_back(c, registry_, ranks_.first());
  frames_ = std::make_unique<Frames>(std::move(outputs), posts_);
}

void OneRun::build() {
  const int dimension = int(w_.dimension);
  packing_ =
      obtain_packing(registry_, w_.packing, w_.packing_request(), options_.packing_cache, monitor_, ranks_.link());
  monitor_.info(fmt::format("packing `{}`: {} particles{}", w_.packing.type, packing_.count,
                            packing_.from_cache ? " (kept from an earlier run)" : ""));
  memory_is_for(packing_.particles.position.size(), 0);
  for (const AskedGot& line : packing_.particles.report) monitor_.info(asked_got_text(line));
  if (options_.resume && ranks_.first())
    refuse_changes(options_.resume->about, provenance_of(w_, registry_, packing_.hash), options_.accept_changed_plugins,
                   monitor_);
  resolve();
  const Materials materials = deal_packing(packing_, w_, ranks_.link());
  if (w_.from)
    branch_.emplace(Beginner{w_, places_, about_.resolved, config_["provenance"], packing_.particles, materials,
                             registry_, others_, options_.accept_changed_plugins},
                    monitor_);
  laws_->within([&] {
    EngineSettings settings = w_.engine_settings(monitor_.threads());
    settings.link = ranks_.link();
    simulation_ =
        std::make_unique<Simulation>(assemble(packing_.particles, materials, dimension, w_.thickness, ranks_.link()),
                                     laws_->interactions(), settings);
    forget_packing();
    bonding_ = simulation_->bond(w_.bonding.rule());
  });
  memory_is_for(simulation_->state().particles.size(), simulation_->state().bonds.size());
  monitor_.info(bonds_text(bonding_));
  const double porosity = packing_porosity();
  {
    StepViews views(*simulation_, others_);
    const SimulationView& part = views.part();
    for (std::size_t l = 0; l < laws_->size(); ++l)
      others_.together([&] { drawn_.push_back(drawn_parameters(laws_->named(l), part)); });
    for (const auto& of_law : drawn_)
      for (const DrawnParameter& drawn : of_law) monitor_.info("  " + drawn.text());
    others_.together([&] { check_specimen(part, porosity, w_.checks, monitor_); });
  }
  if (branch_ && !branch_->goes_on()) begin_on_specimen();
  laws_->within([&] {
    StepViews views(*simulation_, others_);
    time_column_ = add_columns(views, *simulation_, *protocol_, protocol_id(), posts_, curves_, monitor_);
  });
  frames_->begin(ranks_.told(options_.folder.string()), monitor_);
  laws_->within([&] {
    simulation_->prepare();
    check_time_step(*simulation_, w_.checks, monitor_);
  });
  loading_checks_.emplace(w_.checks);
  checkpoints_.emplace(
      w_.checkpoints, options_.folder, curves_, [&](Archive& to) { return archive_run(to, parts()); }, ranks_,
      monitor_);
  if (ranks_.first()) curves_.open(options_.folder / "curves.csv");
}

/// The particles stand in the simulation, each rank's share of them; what the packing says of itself stays.
void OneRun::forget_packing() {
  PackedParticles& p = packing_.particles;
  p.position = {};
  p.radius = {};
  p.columns = {};
}

/// The full input, and what made the result: running it again gives the same bits.
void OneRun::resolve() {
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

void OneRun::begin_on_specimen() {
  monitor_.info(branch_->text());
  const Archive::Group engine(branch_->archive(), "engine");
  laws_->within([&] { simulation_->take_specimen(branch_->archive()); });
}

RunOutcome run_workflow(const LoadedWorkflow& loaded, const Registry& registry, const RunOptions& options,
                        RunMonitor& monitor) {
  return OneRun(loaded, registry, options, monitor)();
}

}  // namespace breccia
