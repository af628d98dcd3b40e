// SPDX-License-Identifier: BSD-3-Clause
#include "check/protocol_rig.hpp"

#include <algorithm>
#include <cmath>

namespace breccia {
namespace {

constexpr PluginId under_test{Protocol::kind, "under test"};

}  // namespace

ProtocolRig::ProtocolRig(const Registry& registry, const PackedParticles& packing, const PluginStack& laws,
                         std::unique_ptr<Protocol> protocol, const RigSettings& settings)
    : protocol_(std::move(protocol)) {
  laws_.emplace(registry, laws);
  EngineSettings engine;
  engine.damping = {settings.damping, settings.damping};
  engine.threads = settings.threads;
  simulation_ = std::make_unique<Simulation>(assemble(packing, {2650}, settings.dimension, settings.thickness),
                                             laws_->interactions(), engine);
  simulation_->bond({GapMeasure::relative, settings.bonding_gap, std::nullopt});
  protocol_->setup(simulation_->view(), *simulation_, rows, host_);
  simulation_->prepare();
  sample_anew(settings.sampling);
}

void ProtocolRig::sample_anew(const Sampling& sampling) {
  loading_.emplace(*simulation_, *laws_, *protocol_, under_test, sampling);
}

LoadingStep ProtocolRig::step(bool last) {
  if (!moved_) laws_->within([&] { simulation_->advance(); });
  const LoadingStep now = loading_->step(last);
  moved_ = false;
  if (!now.row) return now;
  if (simulation_->loading_started()) {
    const SimulationView view = simulation_->view();
    protocol_->sample(view, rows);
    rows.end_row();
    energy_.see(view.energy);
    energy_error_ = std::max(energy_error_, std::abs(view.energy.error()));
  }
  if (now.ends) protocol_->finish(simulation_->view(), rows, summary);
  return now;
}

bool ProtocolRig::archive(Archive& archive) {
  if (!moved_) {
    laws_->within([&] { simulation_->advance(); });
    moved_ = true;
  }
  archive("engine", *simulation_);
  archive("loading", *loading_);
  const Archive::Group group(archive, "protocol");
  return protocol_->archive(archive);
}

}  // namespace breccia
