// SPDX-License-Identifier: BSD-3-Clause
/// A protocol from its library on a small specimen, stepped as a run would step it.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "breccia/protocol.hpp"
#include "run/loading.hpp"
#include "support/support.hpp"

namespace breccia::testing {

/// Curves in memory.
class Rows final : public Recorder, public Curves {
 public:
  std::size_t add(Column column) override {
    columns_.push_back(std::move(column));
    values_.emplace_back();
    return columns_.size() - 1;
  }
  void set(std::size_t column, double value) override { values_.at(column).push_back(value); }
  const std::vector<Column>& columns() const override { return columns_; }
  std::span<const double> column(std::string_view name) const override {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (columns_[k].name == name) return values_[k];
    throw UserError("no curve " + std::string(name));
  }
  std::size_t rows() const override { return values_.empty() ? 0 : values_[0].size(); }
  double last(std::string_view name) const { return column(name).back(); }

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;
};

class Noted final : public Summary {
 public:
  void headline(const ResultName& name, Json value) override { all[name.key()] = std::move(value); }
  void own(const ResultName& name, Json value) override { all[name.key()] = std::move(value); }
  void table(Table) override {}
  std::map<std::string, Json> all;
};

inline std::unique_ptr<Protocol> make_protocol(const std::string& name, Json config) {
  static Registry registry;
  for (const ParamSpec& p : registry.documentation("protocol", name).root.members)
    if (!config.contains(p.name) && !p.fallback.is_null()) config[p.name] = p.fallback;
  return registry.create<Protocol>({name, config});
}

class ProtocolRun {
 public:
  ProtocolRun(const PackedParticles& packing, const Json& law, const std::string& law_name, double tolerance,
              const std::string& protocol, const Json& config, int dimension = 3, int threads = 1) {
    static Registry registry;
    laws_.emplace(registry, PluginStack{{{law_name, law}}});
    EngineSettings settings;
    settings.damping = {0.5, 0.5};
    settings.threads = threads;
    simulation_ =
        std::make_unique<Simulation>(assemble(packing, {2650}, dimension, 1.0), laws_->interactions(), settings);
    simulation_->bond({GapMeasure::relative, tolerance, std::nullopt});
    protocol_ = make_protocol(protocol, config);
    protocol_->setup(simulation_->view(), *simulation_, rows, host_);
    simulation_->prepare();
  }

  /// To the protocol's end; fails when it takes more steps. `watch` sees each sample.
  template <class Watch>
  void go(int most_steps, Watch&& watch, int every = 20, double load_change = 0) {
    Loading loading(*simulation_, *laws_, *protocol_, {Protocol::kind, "under test"},
                    {std::uint64_t(every), load_change});
    for (int k = 0; k < most_steps; ++k) {
      const LoadingStep now = loading.step();
      if (now.row) {
        if (simulation_->loading_started()) protocol_->sample(simulation_->view(), rows);
        watch(*simulation_);
        if (now.ends) {
          Noted noted;
          protocol_->finish(simulation_->view(), rows, noted);
          summary = noted.all;
          return;
        }
      }
      simulation_->advance();
    }
    FAIL() << "the protocol did not end in " << most_steps << " steps: " << protocol_->status();
  }
  void go(int most_steps, int every = 20, double load_change = 0) {
    go(
        most_steps, [](Simulation&) {}, every, load_change);
  }
  Simulation& simulation() { return *simulation_; }

  Rows rows;
  std::map<std::string, Json> summary;

 private:
  SilentHost host_;
  std::optional<ContactLaws> laws_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Protocol> protocol_;
};

/// Volume average over pairs, walls and applied forces, positive in tension [Pa]: as the post-processor `stress` has
/// it.
inline Mat3 mean_stress(Simulation& sim) {
  const SimulationView v = sim.view();
  Mat3 sum = Mat3::Zero();
  const auto& x = v.particles.position;
  for (std::size_t k = 0; k < v.pairs.size(); ++k) {
    const PairForce& f = v.pairs.force[k];
    sum += (x[v.pairs.j[k]] - x[v.pairs.i[k]]) * Vec3(f.fx, f.fy, f.fz).transpose();
  }
  for (const WallContact& c : v.wall_contacts) sum += (c.point - x[c.particle]) * c.force.transpose();
  for (const Mat3& moment : v.particles.boundary_moment) sum += moment;
  return sum / v.specimen.volume;
}

}  // namespace breccia::testing
