// SPDX-License-Identifier: BSD-3-Clause
/// Two platens press a specimen to a strain, stand still for a while, and what stress is left is measured.
/// Sources: name the paper or the standard of the test here; README.md says more.
#include "breccia/protocol.hpp"
#include "breccia/protocol_tools/platens.hpp"

class NewPluginName final : public breccia::Protocol {
 public:
  /// What the workflow says, in SI units and within its range when it comes here. Those of the platens come with them.
  struct Config : breccia::PlatenConfig {
    double strain, hold_time;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Compression to a strain, at which the platens then stand still for a while")
        .source("say where the test comes from")
        .details("Curves: `platen_stress` (mean of both platens' forces over the cross-section), `platen_strain`.");
    breccia::describe_platens(s);
    s.param("strain", &Config::strain).above(0).below(0.5).example("0.1 %").doc("at which the platens are stopped");
    s.param("hold_time", &Config::hold_time).unit("s").at_least(0).example("0.1 ms").doc("how long they stand there");
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  /// Once, before the first step: walls, held particles, columns of curves.csv.
  void setup(const breccia::SimulationView& view, breccia::LoadControl& control, breccia::Recorder& recorder,
             breccia::Host&) override {
    const breccia::SpecimenShape& shape = view.specimen;
    height_ = shape.height;
    area_ = shape.cross_section_area;
    platens_.setup(control, config_, shape.base, shape.base + height_ * shape.axis);
    modulus_ = control.bond_stiffness().modulus;
    stress_column_ = recorder.add(
        {"platen_stress", "Pa", "mean of both platens' forces over the cross-section", breccia::role::machine_stress});
    strain_column_ = recorder.add(
        {"platen_strain", "1", "approach of the platens over the first height", breccia::role::machine_strain});
  }

  /// Before the forces of each step: leads the load. Cheap.
  void step(breccia::LoadControl& control) override {
    const double time = control.time();
    if (!now_.stopped && platens_.approach(control) >= config_.strain * height_) {
      now_.stopped = true;
      now_.stopped_at = time;
    }
    platens_.lead_to(now_.stopped ? 0 : config_.platen_velocity, time);
    platens_.move(control);
  }

  /// After the forces of each step: measures, says where loading begins and when the test has ended.
  breccia::Progress decide(breccia::LoadControl& control) override {
    if (!now_.begun) control.mark_start_of_loading();  // rows of the curves and the energies begin here
    now_.begun = true;
    now_.stress = platens_.force(control) / area_;
    now_.strain = platens_.approach(control) / height_;
    now_.held = now_.stopped ? control.time() - now_.stopped_at - config_.ramp_time : 0;  // since they stand still
    return now_.stopped && now_.held >= config_.hold_time ? breccia::Progress::finished : breccia::Progress::running;
  }

  /// A row of the curves, of the instant of the last `decide`.
  void sample(const breccia::SimulationView&, breccia::Recorder& recorder) const override {
    recorder.set(stress_column_, now_.stress);
    recorder.set(strain_column_, now_.strain);
  }

  /// For rows that are added where the load changes fast; `load_scale`: a load that surely counts.
  double load() const override { return now_.stress; }
  double load_scale() const override { return 1e-4 * modulus_; }

  double share_done() const override {
    return 0.5 * std::min(now_.strain / config_.strain, 1.0) +
           (now_.held > 0 ? 0.5 * std::min(now_.held / config_.hold_time, 1.0) : 0.0);
  }

  /// At the end: numbers for summary.json, below the plugin's name.
  void finish(const breccia::SimulationView&, const breccia::Curves&, breccia::Summary& summary) override {
    summary.own({"final_platen_stress", "Pa"}, now_.stress);
    summary.own("final_platen_strain", now_.strain);
  }

  /// All that changes while the test runs, for checkpoints: what is missing here is lost when a run goes on.
  bool archive(breccia::Archive& archive) override {
    archive("now", now_);
    archive("platens", platens_);
    return true;
  }

 private:
  struct Running {
    bool begun = false, stopped = false;
    double stopped_at = 0, held = 0, stress = 0, strain = 0;  // [s], [s], [Pa], [1]
  };

  Config config_;
  breccia::Platens platens_;
  double height_ = 0, area_ = 0, modulus_ = 0;  // [m], [m2], [Pa]
  std::size_t stress_column_ = 0, strain_column_ = 0;
  Running now_;
};

BRECCIA_PLUGIN(NewPluginName, "protocol", "new_plugin_name")
