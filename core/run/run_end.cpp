// SPDX-License-Identifier: BSD-3-Clause
// What is left of a run: summary and pictures.
#include <fmt/format.h>

#include "engine/specimen.hpp"
#include "results/results_folder.hpp"
#include "run/environment.hpp"
#include "run/one_run.hpp"
#include "run/render.hpp"
#include "run/run_summary.hpp"

namespace breccia {

/// What was measured so far is kept, and says so.
void OneRun::fail(const UserError& e) {
  if (failure_ == e.what()) return;  // it is no other one for being met again
  if (failure_.empty()) failure_ = e.what();
  monitor_.warn(e.what());
}

void OneRun::finish() {
  sum_up_engine(summary_, w_, *simulation_, bonding_, packing_porosity(),
                {interrupted_, monitor_.threads(), first_step_, loop_seconds_});
  if (ranks_.first()) attempt([&] { sum_up_laws(summary_, *laws_, drawn_, simulation_->state()); });
  if (viewable_) {
    StepViews views(*simulation_, others_);
    finish_plugins(views);
  }
  if (!ranks_.first()) return;
  tell_of_ranks();
  sum_up_packing(summary_, packing_.particles.report);
  summary_.set("reference", w_.reference);
  summary_.set("environment", environment());
}

/// Who asks for the whole specimen makes all ranks wait until it is brought together.
void OneRun::tell_of_ranks() {
  if (const int changes = simulation_->changes_of_ranks(); changes > 0)
    monitor_.info(fmt::format("particles changed ranks {} time{}, as work shifted", changes, changes == 1 ? "" : "s"));
  const double seconds = simulation_->seconds_gathering();
  if (ranks_.several())
    monitor_.info(fmt::format("the parts of the specimen were brought together {} time{} for checks and plugins",
                              simulation_->gatherings(), simulation_->gatherings() == 1 ? "" : "s"));
  if (ranks_.several() && seconds > 0.05 * loop_seconds_)
    monitor_.info(
        fmt::format("bringing the specimen together for measurements and files took {:.1f} s, "
                    "that is {:.0f} % of the time of all steps: sample less often",
                    seconds, 100 * seconds / loop_seconds_));
}

/// The first rank's curves, for all that sum up; `told`: where they stand on several ranks.
const Curves& OneRun::curves_of_all(CurveTable& told) {
  if (!ranks_.several()) return curves_;
  Json columns = Json::array();
  std::vector<double> values;
  for (const Column& c : curves_.columns()) {
    columns.push_back({c.name, c.unit, c.doc, c.role});
    const auto of = curves_.column(c.name);
    values.insert(values.end(), of.begin(), of.end());
  }
  columns = Json::parse(ranks_.told(columns.dump()));
  values = ranks_.told(values);
  for (const Json& c : columns) told.add({c[0], c[1], c[2], c[3]});
  const std::size_t rows = columns.empty() ? 0 : values.size() / columns.size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) told.set(c, values[c * rows + row]);
    told.end_row();
  }
  return told;
}

/// Those that have failed have nothing to say.
void OneRun::finish_plugins(StepViews& views) {
  if (energy_check_) energy_check_->finish(views.part().energy, views.part().step, monitor_);
  CurveTable told;
  const Curves& all = curves_of_all(told);
  SummaryTable::Section protocol(summary_, w_.protocol.type);
  attempt([&] {
    views.show(protocol_->sees_parts(), [&](const SimulationView& view) {
      calling(protocol_id(), "summing up", [&] { protocol_->finish(view, all, protocol); });
    });
  });
  for (auto& p : posts_) {
    if (p.has_failed()) continue;
    NamedSummary section(summary_, p);
    const NamedCurves curves(all, p.prefix());
    attempt([&] {
      p.show(views, "summing up",
             [&](Postprocessor& q, const SimulationView& view) { q.finish(view, curves, section); });
    });
  }
}

/// What came after the results were whole. They are so without it.
void OneRun::add_to_summary(double wall_seconds) {
  refuse_if_gone();
  try {
    write_summary(wall_seconds);
  } catch (const UserError& e) {
    monitor_.warn(
        fmt::format("the results are whole, but their summary does not have the last warnings: {}", e.what()));
  }
}

/// The summary as it stands; what grows until the end of the run is set anew.
void OneRun::write_summary(double wall_seconds) {
  summary_.update({"wall_time", "s"}, wall_seconds);
  summary_.update("warnings", monitor_.warnings());
  summary_.write(options_.folder);
}

/// Of the container when the packing had one, else of the specimen as measured.
double OneRun::packing_porosity() const {
  const double container = packing_.particles.container_volume;
  if (container <= 0) return simulation_->porosity();
  return 1 - solid_volume(packing_.particles.radius, w_.space()) / container;
}

/// Pictures of the results in that folder. Nothing that happens here loses the run.
void OneRun::draw(const std::filesystem::path& results) {
  if (w_.renderers.empty()) return;
  try {
    for (const auto& file : render_all(w_.renderers, registry_, {results, options_.folder}, monitor_))
      monitor_.info("picture " + file.filename().string());
  } catch (const Cancelled&) {
    monitor_.warn("stopped on request before all pictures were drawn: `breccia render` draws them");
    interrupted_ = true;
  }
}

}  // namespace breccia
