// SPDX-License-Identifier: BSD-3-Clause
/// Time of the step loop per bond, on the specimen of a workflow: breccia_bench WORKFLOW [THREADS...]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "breccia/contact_law.hpp"
#include "breccia/protocol.hpp"
#include "engine/assembly.hpp"
#include "engine/simulation.hpp"
#include "output/curve_table.hpp"
#include "run/packing_cache.hpp"
#include "run/workflow.hpp"

namespace {

using namespace breccia;

class Quiet final : public Host {
 public:
  void info(std::string_view) override {}
  void warn(std::string_view text) override { fmt::print(stderr, "{}\n", text); }
  void progress(std::string_view, double) override {}
  bool cancelled() const override { return false; }
  int threads() const override { return 2; }
};

/// Minimum and median over batches of steps [ns per bond and step].
std::pair<double, double> measure(const Workflow& w, const Registry& registry, const PackedParticles& packing, int threads) {
  auto law = registry.create<ContactLaw>(w.contact_law);
  auto protocol = registry.create<Protocol>(w.protocol);
  EngineSettings settings;
  settings.damping = {w.damping.translational, w.damping.rotational};
  settings.threads = threads;
  Simulation sim(assemble(packing, {w.material.density}, int(w.dimension), w.thickness), *law, settings);
  sim.bond(w.bonding.rule());
  Quiet host;
  CurveTable curves;
  protocol->setup(sim.view(), sim, curves, host);
  sim.prepare();
  constexpr int batches = 40, steps = 50;
  std::vector<double> ns;
  for (int b = 0; b < batches; ++b) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k) {
      protocol->step(sim);
      sim.forces();
      sim.advance();
    }
    ns.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / steps / double(sim.state().bonds.size()));
  }
  std::sort(ns.begin(), ns.end());
  return {ns.front(), ns[ns.size() / 2]};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw UserError("usage: breccia_bench WORKFLOW [THREADS...]");
    Registry registry;
    const LoadedWorkflow loaded = load_workflow(argv[1], {}, registry);
    const Workflow& w = loaded.workflow;
    Quiet host;
    const PackingOutcome packing = obtain_packing(registry, w.packing, {int(w.dimension), w.thickness, std::uint64_t(w.seed)}, default_cache_folder(), host);
    std::vector<int> threads;
    for (int k = 2; k < argc; ++k) threads.push_back(std::stoi(argv[k]));
    if (threads.empty()) threads = {1, 2};
    fmt::print("{}: {} particles; 40 batches of 50 steps, ns per bond-step\n", w.name, packing.particles.position.size());
    double one = 0;
    for (const int t : threads) {
      const auto [least, median] = measure(w, registry, packing.particles, t);
      if (one == 0) one = least;
      fmt::print("{} thread{}: minimum {:.2f}, median {:.2f}, speed-up {:.2f}\n", t, t == 1 ? " " : "s", least, median, one / least);
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  }
}
