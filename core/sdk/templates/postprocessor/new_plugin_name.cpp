// SPDX-License-Identifier: BSD-3-Clause
/// How much longer the intact bonds have become since loading began, on average.
/// Sources: name the paper of the measure here; README.md says more.
#include "breccia/postprocessor.hpp"

class NewPluginName final : public breccia::Postprocessor {
 public:
  /// What the workflow says, in SI units and within its range when it comes here.
  struct Config {
    bool field;
  };

  /// One declaration for each parameter: messages, `breccia describe` and the editor's help are made from it.
  static void describe(breccia::Schema<Config>& s) {
    s.summary("Mean elongation of the intact bonds since loading began")
        .source("say where the measure comes from")
        .details("Curve: `mean_bond_elongation`. Field of the bonds' files: `bond_elongation`.");
    s.param("field", &Config::field).fallback(true).doc("write the elongation of each bond into the bonds' files");
  }

  explicit NewPluginName(const Config& config) : config_(config) {}

  /// Before the first step: the columns of curves.csv, with their units.
  void begin(const breccia::SimulationView&, breccia::Recorder& recorder, breccia::Host&) override {
    column_ = recorder.add({"mean_bond_elongation", "m", "of the intact bonds, since loading began"});
  }

  /// A row of the curves. It sees everything (`breccia/views.hpp`) and changes nothing.
  void sample(const breccia::SimulationView& view, breccia::Recorder& recorder) override {
    recorder.set(column_, mean(view));
  }

  /// Values of particles or bonds for the files that outputs write.
  void fields(const breccia::SimulationView& view, std::vector<breccia::Field>& all) override {
    if (!config_.field) return;
    breccia::Field field{breccia::Field::On::bonds, "bond_elongation", "m", 1, {}};
    for (std::size_t b = 0; b < view.bonds.size(); ++b) field.values.push_back(elongation(view, b));
    all.push_back(std::move(field));
  }

  /// At the end: numbers for summary.json, below the plugin's name (`own`) or on top (`headline`).
  void finish(const breccia::SimulationView& view, const breccia::Curves&, breccia::Summary& summary) override {
    summary.own({"mean_bond_elongation", "m"}, mean(view));
  }

  /// All that changes while the test runs, for checkpoints: here nothing, since each row is measured anew.
  bool archive(breccia::Archive&) override { return true; }

 private:
  /// Branch vectors are asked of the view: space may repeat itself.
  static double elongation(const breccia::SimulationView& view, std::size_t bond) {
    const breccia::Index i = view.bonds.i[bond], j = view.bonds.j[bond];
    return view.branch(view.particles.position[i], view.particles.position[j]).norm() -
           view.initial_branch(i, j).norm();
  }
  /// Sums in the order of the bonds: the same bits for any number of threads. 0 without intact bonds.
  static double mean(const breccia::SimulationView& view) {
    double sum = 0, count = 0;
    for (std::size_t b = 0; b < view.bonds.size(); ++b) {
      if (view.bonds.state[b] != breccia::BondState::intact) continue;
      sum += elongation(view, b);
      ++count;
    }
    return count > 0 ? sum / count : 0.0;
  }

  Config config_;
  std::size_t column_ = 0;
};

BRECCIA_PLUGIN(NewPluginName, "postprocessor", "new_plugin_name")
